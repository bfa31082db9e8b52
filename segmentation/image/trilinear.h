#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// The voxels that a place between voxels is interpolated from, and their weights. Those beyond the
/// grid are left out, as if it were zero there.
struct TrilinearCorners {
  int count = 0;
  std::array<std::size_t, 8> voxels;
  std::array<double, 8> weights;

  template <class T>
  double of(const Volume<T>& image) const {
    double sum = 0;
    for (int c = 0; c < count; ++c) sum += weights[c] * image.values[voxels[c]];
    return sum;
  }
};

/// `index`: in voxels (Volume::index).
template <class T>
TrilinearCorners trilinear_corners(const Volume<T>& grid, const Eigen::Vector3d& index) {
  const Eigen::Vector3i low = index.array().floor().template cast<int>();
  const Eigen::Vector3d t = index - low.cast<double>();
  TrilinearCorners corners;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i bits(corner & 1, corner >> 1 & 1, corner >> 2);
    const Eigen::Vector3i v = low + bits;
    if (!grid.contains(v.x(), v.y(), v.z())) continue;
    double weight = 1;
    for (int a = 0; a < 3; ++a) weight *= bits[a] ? t[a] : 1 - t[a];
    corners.voxels[corners.count] = grid.offset(v.x(), v.y(), v.z());
    corners.weights[corners.count++] = weight;
  }
  return corners;
}

}  // namespace mammotwin
