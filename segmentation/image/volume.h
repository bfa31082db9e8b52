#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace mammotwin {

/// Values on an axis-aligned grid in patient LPS: voxel (i, j, k) has its centre at
/// origin + (i, j, k) * spacing [mm], i towards the patient's left, j posterior, k superior;
/// i runs fastest in `values`. Every image is brought to this form when it is read.
template <class T>
struct Volume {
  Eigen::Vector3i size = Eigen::Vector3i::Zero();
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();  ///< [mm]
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();   ///< centre of voxel (0, 0, 0) in LPS [mm]
  std::vector<T> values;

  Volume() = default;
  Volume(const Eigen::Vector3i& size, const Eigen::Vector3d& spacing, const Eigen::Vector3d& origin,
         T value = T())
      : size(size),
        spacing(spacing),
        origin(origin),
        values(static_cast<std::size_t>(size.x()) * size.y() * size.z(), value) {}

  /// The same grid with other values.
  template <class U>
  Volume<U> like(U value = U()) const {
    return Volume<U>(size, spacing, origin, value);
  }

  std::size_t offset(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * size.y() + j) * size.x() + i;
  }
  T& operator()(int i, int j, int k) { return values[offset(i, j, k)]; }
  const T& operator()(int i, int j, int k) const { return values[offset(i, j, k)]; }

  bool contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size.x() && j < size.y() && k < size.z();
  }
  Eigen::Vector3d position(int i, int j, int k) const {
    return origin + spacing.cwiseProduct(Eigen::Vector3d(i, j, k));
  }
  /// Of the voxel at `values[at]`.
  Eigen::Vector3d position(std::size_t at) const {
    const std::size_t row = at / size.x();
    return position(static_cast<int>(at % size.x()), static_cast<int>(row % size.y()),
                    static_cast<int>(row / size.y()));
  }
  /// Continuous voxel index of a point in LPS.
  Eigen::Vector3d index(const Eigen::Vector3d& x_in_lps) const {
    return (x_in_lps - origin).cwiseQuotient(spacing);
  }
  double voxel_volume() const { return spacing.prod(); }  ///< [mm^3]
};

}  // namespace mammotwin
