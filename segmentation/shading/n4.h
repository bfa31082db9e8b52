#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/files/raw_image.h"

namespace mammotwin {

/// Log of the multiplicative bias field of a (coarse) image by N4, inside `mask` (same size):
/// ITK's N4BiasFieldCorrectionImageFilter, after Tustison et al., IEEE TMI 29 (2010), 1310-1320,
/// with two levels of six control points and up to 40 iterations a level (study of segmentation:
/// two levels leave 0.02 to 0.03 in the log, three eat gland). Values of the image must be
/// positive.
std::vector<float> n4_log_bias(const RawImage& image, const std::vector<std::uint8_t>& mask);

}  // namespace mammotwin
