#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// Connected parts of a mask (neighbours across faces). Part n, from 1, has `sizes[n]` voxels;
/// parts are numbered in the order of their first voxel; `sizes[0]` is what lies outside.
struct Components {
  Volume<std::int32_t> ids;
  std::vector<std::size_t> sizes;

  /// Number of the largest part; 0 if there is none. The first of equals.
  std::int32_t largest() const;
};

Components connected_components(const Volume<std::uint8_t>& mask);

/// The mask with its largest part only.
Volume<std::uint8_t> largest_component(const Volume<std::uint8_t>& mask);

/// The mask without parts of less than `least_ml`.
Volume<std::uint8_t> without_small_components(const Volume<std::uint8_t>& mask, double least_ml);

}  // namespace mammotwin
