#pragma once

#include <cstdint>

#include "segmentation/image/volume.h"

namespace mammotwin {

inline constexpr std::uint8_t walker_free = 0, walker_inside = 1, walker_outside = 2;

/// Voxels from which a random walker reaches an inside seed before an outside one with a
/// probability over one half, after Grady, IEEE PAMI 28 (2006), 1768-1783: steps have the weight
/// exp(-beta (difference / range)^2), beta = 100, `range` the contrast
/// of the two sides. Walks stay in `allowed`.
Volume<std::uint8_t> random_walk(const Volume<float>& image, const Volume<std::uint8_t>& allowed,
                                 const Volume<std::uint8_t>& seeds, double range);

}  // namespace mammotwin
