#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/evaluate/registration/real_marks.h"
#include "registration/export/lesion_table.h"

namespace mammotwin {

/// How far a lesion's prediction lies from its mark, as said in `predicted` (a row of lesions.csv):
///   judged                       "place", or "depth" where the mark's image is missing
///   spacing                      "known" or "assumed"
///   depth_off_mm                 mark less prediction, from the detector's edge
///   error_mm, baseline_error_mm  distance on the detector, or in depth alone
///   in_50, in_90                 is the mark in the ellipse of that probability, or in that
///                                interval of depth?
///   reach_90_mm                  semi-major axis of the 90 % ellipse, or half the interval
/// Throws std::runtime_error where the row has no ellipse.
nlohmann::json judged_mark(const RealMark& mark, const PlacedMark& place,
                           const LesionRow& predicted);

/// A row for each mark of `marks.csv` in the patient's folder, judged by what lies in `results`:
/// `case`, `lesion`, `view`, `end` of the search ("none" without a mammogram), and `judged_mark`'s
/// keys or a `reason` why there are none.
nlohmann::json real_pair_rows(const std::filesystem::path& patient_folder,
                              const std::filesystem::path& results);

/// Lines for a terminal, one a mark.
std::string real_pairs_summary(const nlohmann::json& cases);

}  // namespace mammotwin
