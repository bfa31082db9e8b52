#pragma once

#include <cstdint>

#include "segmentation/image/volume.h"
#include "segmentation/segment_quality.h"

namespace mammotwin {

/// Doubts fat suppression where more than 5 ml of `interior` are brighter than twice fat after
/// smoothing by 6 mm. `image`: widely_corrected, so that the bias of failed suppression is left.
void judge_suppression(const Volume<float>& image, const Volume<std::uint8_t>& interior,
                       SegmentQuality& quality);

}  // namespace mammotwin
