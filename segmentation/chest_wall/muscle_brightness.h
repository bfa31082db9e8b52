#pragma once

#include <vector>

#include "segmentation/chest_wall/polar_rays.h"
#include "segmentation/chest_wall/wall_prior.h"

namespace mammotwin {

/// Brightness of the muscle behind both breasts, of fat 1, from the image alone: the most frequent
/// brightness of the middle one of three histograms (breast, muscle, what lies behind it) that
/// explain the samples of all rays. How likely a sample belongs to each is known beforehand from
/// where the wall usually lies (`usual`) and 13 mm of muscle; expectation maximisation finds the
/// histograms. 0 where too few samples have muscle in them.
double learnt_muscle(const PolarRays& rays, const PectoralWall& grid,
                     const std::vector<UsualRadius>& usual, double z_low, double z_high);

}  // namespace mammotwin
