#pragma once

#include <vector>

#include "segmentation/chest_wall/half_breast.h"
#include "segmentation/lesion/lesion_seed.h"
#include "segmentation/segment.h"
#include "segmentation/shading/half_images.h"

namespace mammotwin {

/// Throws std::runtime_error, naming the lesion, if a seed lies outside the breast. `in_mirror`:
/// both are seen so.
void check_seeds(const HalfBreast& half, const std::vector<PlacedSeed>& seeds, bool in_mirror);

/// Label per voxel of one half: 0, or `label::lesion` + n for seed n. Throws std::runtime_error if
/// a ball or a map holds no voxel of the breast. Doubts go to `quality`.
Volume<std::uint8_t> find_lesions(const HalfBreast& half, const HalfImages& images,
                                  const std::vector<PlacedSeed>& seeds, bool fat_suppressed,
                                  const SegmentOptions& options, SegmentQuality& quality);

}  // namespace mammotwin
