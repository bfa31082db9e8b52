#pragma once

#include "segmentation/body/breast_region.h"
#include "segmentation/body/nipple.h"
#include "segmentation/segment_quality.h"

namespace mammotwin {

/// Judges a region by the breast and not by itself: doubts it where more than 3 % of the pendant
/// tissue lies outside, or a part of a lesion; refuses it over 15 %, or where a lesion's centroid
/// or the nipple lies outside. Every later stage keeps to the region.
void judge_region(const FoundRegion& found, const Segmentation& s, SegmentQuality& quality);

/// Doubts a nipple that does not stand out of the skin, or beside which another place stands out
/// nearly as well more than 15 mm away.
void judge_nipple(const Nipple& nipple, SegmentQuality& quality);

}  // namespace mammotwin
