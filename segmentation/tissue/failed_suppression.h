#pragma once

#include <cstdint>

#include "segmentation/image/volume.h"
#include "segmentation/segment_quality.h"

namespace mammotwin {

/// Where fat suppression failed in the breast's `interior`: parts of 1 ml and more that are
/// brighter than twice fat after smoothing by 6 mm, of which a quarter lies within 10 mm below the
/// skin (what is as bright farther in only is gland or a lesion) and most, or which are clearly
/// brighter than `gland` (of fat), and what is over 1.5 times as bright within 9 mm of them.
/// `image`: widely_corrected, so that the bias of failed suppression is left, looked at in
/// `statistics`. `depth`: below the skin [mm].
Volume<std::uint8_t> failed_suppression(const Volume<float>& image,
                                        const Volume<std::uint8_t>& statistics,
                                        const Volume<std::uint8_t>& interior,
                                        const Volume<float>& depth, double gland);

/// Doubts fat suppression where it failed in more than 5 ml in front of the skin over the
/// breastbone.
void judge_suppression(const Volume<std::uint8_t>& failed, double sternal_y,
                       SegmentQuality& quality);

}  // namespace mammotwin
