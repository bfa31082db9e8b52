#pragma once

#include <vector>

#include "segmentation/chest_wall/polar_rays.h"

namespace mammotwin {

/// What it costs to put the wall between the samples d - 1 and d of each ray; laid out as the
/// intensities of the rays. `contrast` is that of each ray.
///
/// Where the contrast knows gland, a tissue is taken for muscle only if that is likelier than
/// gland, and the edge is that of the likelihoods: from gland to muscle brightness changes little,
/// and the other way.
///
/// 0.5 times a region term (fat in the 6 mm outside, muscle in the 7 mm inside, by
/// log-likelihood), minus 2 times the signed edge (outward: darker where muscle is brighter than
/// fat; 1 to 3 mm to either side), plus dark tissue in front of it (per 10 mm), plus the dark share
/// of the 7 mm inside (else the lung's sharper edge wins), plus 0 to 2 where 2 to 7 mm inside it is
/// 1.5 to 3 times as rough as muscle (gland is mixed with fat); not within 4 mm of the skin. The
/// study of segmentation measured that the first three terms are needed.
std::vector<float> wall_costs(const PolarRays& rays, const std::vector<WallContrast>& contrast);

}  // namespace mammotwin
