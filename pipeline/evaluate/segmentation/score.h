#pragma once

#include <cstdint>
#include <optional>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// Overlap of two masks on one grid: 2 |a and b| / (|a| + |b|); empty if both are.
std::optional<double> dice(const Volume<std::uint8_t>& a, const Volume<std::uint8_t>& b);

/// Distances between two surfaces [mm], from each voxel of one to the nearest of the other, both
/// ways together.
struct SurfaceDistance {
  double mean = 0, median = 0, p95 = 0, largest = 0;
};
/// Empty if either surface is.
std::optional<SurfaceDistance> surface_distance(const Volume<std::uint8_t>& a,
                                                const Volume<std::uint8_t>& b);

/// How near a segmentation comes to the truth, inside the true region. What either lacks is empty.
struct SegmentationScore {
  std::optional<double> breast_dice, skin_dice, fibroglandular_dice;
  /// The same without the voxels whose true fraction is a half to within 0.06: noise alone puts
  /// those on one side or the other.
  std::optional<double> clear_fibroglandular_dice;
  /// 2 sum(min(a, b)) / sum(a + b) of the voxels' fibroglandular fractions.
  std::optional<double> fibroglandular_fraction_dice;
  std::optional<double> fibroglandular_volume_ratio;  ///< found over true, of fractions
  std::optional<SurfaceDistance> chest_wall, skin_surface;
  std::optional<double> lesion_dice, lesion_centroid_mm;  ///< the worst of the lesions
  double nipple_mm = 0;
};

/// `truth` carries labels (both sides or one), fractions on the same grid, region, lesions in label
/// order and nipple. What was found is read at the truth's voxel centres. The
/// chest wall is scored away from the region's edges by 5 mm, fibroglandular tissue this far and
/// more off the true muscle and outside true lesions, which have a score of their own. Columns in
/// which the truth has no muscle are not scored: nothing says where the breast ends there.
SegmentationScore score_segmentation(const Segmentation& truth, const Segmentation& found,
                                     double fibroglandular_off_muscle_mm = 0);

}  // namespace mammotwin
