#pragma once

#include <cstdint>

#include "segmentation/image/volume.h"
#include "segmentation/segment_quality.h"

namespace mammotwin {

/// Doubts fat suppression where more than 5 ml of `interior`, in front of the skin over the
/// breastbone, are brighter than twice fat after smoothing by 6 mm, in parts of which a quarter
/// lies within 10 mm below the skin: what is as bright farther in only is gland or a lesion.
/// `image`: widely_corrected, so that the bias of failed suppression is left. `depth`: below the
/// skin [mm].
void judge_suppression(const Volume<float>& image, const Volume<std::uint8_t>& interior,
                       const Volume<float>& depth, double sternal_y, SegmentQuality& quality);

}  // namespace mammotwin
