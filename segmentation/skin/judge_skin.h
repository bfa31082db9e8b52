#pragma once

#include "segmentation/segment.h"
#include "segmentation/skin/skin_slab.h"

namespace mammotwin {

/// The skin's thickness [mm] to go on with: as given, as measured, or 1.5 where it could not be.
/// Sets what the quality says of it, with doubts where it is unusual or not known.
double judge_skin(const SkinSlab& skin, const SegmentOptions& options, SegmentQuality& quality);

}  // namespace mammotwin
