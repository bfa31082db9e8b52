#pragma once

#include <vector>

#include "segmentation/half_breast.h"
#include "segmentation/lesion_seed.h"
#include "segmentation/segment.h"

namespace mammotwin {

/// Label per voxel of one half: 0, or `label::lesion` + n for seed n. Throws std::runtime_error if
/// a seed lies outside the breast. Doubts go to `quality`.
Volume<std::uint8_t> find_lesions(const HalfBreast& half, const std::vector<PlacedSeed>& seeds,
                                  bool fat_suppressed, const SegmentOptions& options,
                                  SegmentQuality& quality);

}  // namespace mammotwin
