#pragma once

#include <filesystem>
#include <string>

namespace mammotwin {

/// What a search may be told wrongly, or not at all.
inline constexpr const char* kSpoils[] = {"nipple", "pectoral", "abdomen"};

/// Copies a made registration case and spoils it. "nipple": no marker in either mammogram, so that
/// the nipple is not in profile; "pectoral": 10 mm of the MLO along the chest wall said to be
/// muscle; "abdomen": a fold of it below the breast in the MLO. What is there already is kept.
/// Throws std::runtime_error where the case has no marker to take away, or its files are missing.
void spoil_registration_case(const std::filesystem::path& made, const std::string& spoil,
                             const std::filesystem::path& folder);

}  // namespace mammotwin
