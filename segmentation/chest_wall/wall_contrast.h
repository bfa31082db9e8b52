#pragma once

#include <vector>

#include "segmentation/chest_wall/polar_rays.h"

namespace mammotwin {

/// Brightness of fat and muscle and roughness of muscle as measured on both sides of a first wall,
/// of each ray: medians over 60 mm of height and 45 degrees, of the rays whose `cost` says that the
/// image supports the wall there. Where fewer than a tenth do, `usual` stays.
///
/// Gland is known where it differs from muscle by more than muscle does from itself: on real
/// patients of mixed muscle, or where little gland lies in front, it is not.
///
/// One brightness for the whole image is too little: what is left of the bias goes on behind the
/// wall, where the coil is far.
std::vector<WallContrast> local_contrasts(const PolarRays& rays, const std::vector<double>& depth,
                                          const std::vector<float>& cost,
                                          const WallContrast& usual);

}  // namespace mammotwin
