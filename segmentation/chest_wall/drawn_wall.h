#pragma once

#include <vector>

#include "segmentation/chest_wall/wall_prior.h"

namespace mammotwin {

/// The front of the muscle as a person drew it, on the rays of PectoralWall's grid: points in a few
/// slices, in any order. Between points of one height that lie at most 20 degrees apart, and
/// between heights at most 60 mm apart, radii are interpolated, with a spread of 0.7 mm on the
/// points' height and a tenth of the distance to it more; on other rays nothing is known. Points
/// above and below the grid do not count. Throws std::runtime_error where one lies on no ray, or
/// none counts.
std::vector<UsualRadius> drawn_radii(const PectoralWall& grid,
                                     const std::vector<Eigen::Vector3d>& points_in_lps);

/// What was drawn, and what is usual where nothing was.
std::vector<UsualRadius> with_drawn(std::vector<UsualRadius> usual,
                                    const std::vector<UsualRadius>& drawn);

}  // namespace mammotwin
