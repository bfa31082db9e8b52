#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace mammotwin {

/// Mammograms that are not what patient.toml says: another patient's, on the same side of the
/// image; the other breast's, on its other side; upside down; CC for MLO and the other way round;
/// and, beside her own CC, an MLO that is another patient's or upside down.
inline constexpr const char* kMisfits[] = {
    "another_patient", "other_breast",           "upside_down",
    "views_exchanged", "mlo_of_another_patient", "mlo_upside_down"};

/// Copies a made registration case and exchanges its mammograms; `another` is one of another
/// patient. landmarks.csv says where the marks then lie; for another patient's mammograms, which
/// show none of them, where they would on her own. What is there already is kept. Throws
/// std::runtime_error where a file is missing.
void make_misfit_case(const std::filesystem::path& made, const std::filesystem::path& another,
                      const std::string& misfit, const std::filesystem::path& folder);

/// What of a judged case's row (registration_rows.h) says whether its misfit was noticed:
/// `end_cc`, `end_mlo` ("refused": by register, with a reason; "failed": another stage left no
/// product, which notices nothing), `lesions_in_90` of `lesions` marks,
/// and `noticed`: no view whose mammogram is wrong was registered, or every lesion's mark lies in
/// its 90 % ellipse.
void judge_misfit(const std::string& misfit, nlohmann::json& row);

}  // namespace mammotwin
