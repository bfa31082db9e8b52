#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// Voxels `low` to `high` of a grid, both included.
struct VoxelBox {
  Eigen::Vector3i low, high;
  bool is_empty() const { return (low.array() > high.array()).any(); }
};

/// The box around everything that is not 0, widened by `margin` voxels within the grid; of a mask
/// without a voxel, empty where `margin` is 0.
VoxelBox box_around(const Volume<std::uint8_t>& mask, int margin);

/// The part of a volume from voxel `low` to voxel `high`, both included.
template <class T>
Volume<T> cropped(const Volume<T>& volume, const Eigen::Vector3i& low,
                  const Eigen::Vector3i& high) {
  Volume<T> out(high - low + Eigen::Vector3i::Ones(), volume.spacing,
                volume.position(low.x(), low.y(), low.z()));
  std::size_t n = 0;
  for (int k = low.z(); k <= high.z(); ++k)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int i = low.x(); i <= high.x(); ++i) out.values[n++] = volume(i, j, k);
  return out;
}

template <class T>
Volume<T> cropped(const Volume<T>& volume, const VoxelBox& box) {
  return cropped(volume, box.low, box.high);
}

}  // namespace mammotwin
