#pragma once

#include "segmentation/chest_wall/half_breast.h"
#include "segmentation/chest_wall/wall_stage.h"
#include "segmentation/segment_quality.h"

namespace mammotwin {

/// Doubts a wall that the image does not support, that has fat rather than muscle behind it, or
/// that may as well lie elsewhere: in the slices of the breasts that the region holds.
void judge_wall(const FoundWall& found, const BreastFrame& frame, const BreastRegion& region,
                SegmentQuality& quality);

/// Doubts a wall on which a lesion lies over more than 3 cm2: a wall in front of a part of the
/// lesion looks the same. `lesions` is 0 outside the lesions, on the grid of `half`.
void judge_lesions_on_wall(const HalfBreast& half, const Volume<std::uint8_t>& lesions,
                           SegmentQuality& quality);

}  // namespace mammotwin
