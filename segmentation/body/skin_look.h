#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// What a nipple shows by, at one point of the skin. The last three are in spreads (half the
/// distance of the 16th and 84th percentile, but not less than what unevenness of the outline and
/// noise make) from the median of all points, cut at -3 and 6.
struct SkinPoint {
  Eigen::Vector3d x_in_lps;
  double stands_out = 0;   ///< of the skin smoothed over 6 mm: papilla, and edge of a retracted one
  double bright = 0;       ///< 1 to 5 mm below: papilla and areola are thick and take up agent
  double bright_deep = 0;  ///< 6 to 12 mm below: ducts and gland come together there

  double sum() const { return stands_out + bright + bright_deep; }
};

/// The skin of a body within `reach_mm` of a point, where it faces forward; each value a mean over
/// 4 mm. `look`: an image in which papilla and gland are brighter than fat, on the body's grid;
/// brightness is that over the mean of 12 mm around.
std::vector<SkinPoint> skin_around(const Volume<std::uint8_t>& body, const Volume<float>& look,
                                   const Eigen::Vector3d& middle, double reach_mm);

}  // namespace mammotwin
