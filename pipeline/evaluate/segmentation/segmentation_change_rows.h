#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "pipeline/evaluate/segmentation/mri_changes.h"

namespace mammotwin {

/// A patient.toml whose MRI is segmented as it is and changed, each in a process of its own; what
/// comes of it stays in `folder`/<change>.
struct SegmentationChangeCase {
  std::string name;
  std::filesystem::path patient_toml, folder;
  std::vector<MriChange> changes;
};

/// Adds a line "none" and one a change, how far each thing moved that the first segmentation found
/// [mm], seen in its frame: chest wall and skin within its region and 5 mm off its edges
/// (wall_median_mm, wall_p95_mm, wall_over_5 [share], skin_p95_mm), nipple_mm, lesion_mm (the
/// worst); of its breast that the changed image shows the shares outside the region there, of what
/// hangs in front of the breastbone's skin (left_out) and of all (left_out_of_all); volumes as
/// ratios changed over first (breast_ratio, gland_ratio); the status of that line's segmentation
/// and what it doubts. `unsaid`: what moved too far (wall 5 mm at 95 %, nipple 8 mm, lesion 3 mm, 3
/// % left out) and neither doubts. What a case lacks is null; where a segmentation ends badly its
/// `reason` says why.
void add_segmentation_change_rows(const SegmentationChangeCase& asked,
                                  const std::function<void(const nlohmann::json&)>& add);

/// By change: how many cases, how far the wall moved, in how many something moved unsaid.
std::string segmentation_changes_summary(const nlohmann::json& rows);

}  // namespace mammotwin
