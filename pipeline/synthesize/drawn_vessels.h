#pragma once

#include <cstdint>

#include "pipeline/synthesize/tissue_map.h"

namespace mammotwin {

/// Vessels full of contrast agent in an image of `tissue`, fat = 1: tubes of 1.8 to 5 mm that
/// taper to 0.6 of that over 40 to 140 mm, wander through fat and fibroglandular tissue, one for
/// each 60 ml of fat, as bright as `brightness`. The truth of tissue does not know them.
void draw_vessels(double brightness, std::uint64_t seed, const TissueMap& tissue,
                  Volume<float>& signal);

}  // namespace mammotwin
