#pragma once

#include <nlohmann/json_fwd.hpp>

#include "segmentation/segmentation.h"

namespace mammotwin {

// What segmentation gets wrong of real MRI, said to it as 3D Slicer markups, so that a patient is
// registered with it.

/// An ROI whose lateral side leaves out `share` of the breast in the true region, or as much as
/// leaves every lesion 10 mm inside.
nlohmann::json region_without_flank(const Segmentation& truth, double share);

/// Curves along the muscle's front in slices 30 mm apart, points 15 mm apart; from the nipple to
/// the region's lateral side they lie ever deeper than the truth, there by `off_mm` (negative: too
/// far in front).
nlohmann::json wall_off_laterally(const Segmentation& truth, double off_mm);

}  // namespace mammotwin
