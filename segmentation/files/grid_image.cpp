#include "segmentation/files/grid_image.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace mammotwin {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// Which file axis runs along each patient axis, and whether it runs against it.
struct AxisMap {
  std::array<int, 3> file_axis;
  std::array<bool, 3> reversed;
  double deviation_degrees = 0;  ///< largest angle between a file axis and its patient axis
};

AxisMap nearest_axes(const Eigen::Matrix3d& direction) {
  AxisMap best;
  double best_score = -1;
  std::array<int, 3> p{0, 1, 2};
  constexpr std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (const auto& order : orders) {
    double score = 0;
    for (int a = 0; a < 3; ++a) score += std::abs(direction(a, order[a]));
    if (score > best_score) best_score = score, p = order;
  }
  for (int a = 0; a < 3; ++a) {
    const double cosine = direction(a, p[a]);
    best.file_axis[a] = p[a];
    best.reversed[a] = cosine < 0;
    const double angle = std::acos(std::min(1.0, std::abs(cosine))) * degrees;
    best.deviation_degrees = std::max(best.deviation_degrees, angle);
  }
  return best;
}

void check_orthogonal(const Eigen::Matrix3d& direction) {
  const double error = (direction.transpose() * direction - Eigen::Matrix3d::Identity()).norm();
  if (error < 1e-2) return;  // headers carry four digits or more
  throw std::runtime_error(
      "the image axes are not perpendicular to each other; expected a rectangular grid of voxels "
      "(a sheared or gantry-tilted stack must be resampled first, for example in 3D Slicer)");
}

Volume<float> permuted(const GridImage& image, const AxisMap& map) {
  const std::array<std::ptrdiff_t, 3> file_step{
      1, image.size.x(), static_cast<std::ptrdiff_t>(image.size.x()) * image.size.y()};
  Eigen::Vector3i size;
  Eigen::Vector3d spacing;
  Eigen::Vector3d origin = image.origin;
  std::array<std::ptrdiff_t, 3> step;
  std::ptrdiff_t start = 0;
  for (int a = 0; a < 3; ++a) {
    const int f = map.file_axis[a];
    size[a] = image.size[f];
    spacing[a] = image.spacing[f];
    step[a] = map.reversed[a] ? -file_step[f] : file_step[f];
    if (!map.reversed[a]) continue;
    start += file_step[f] * (size[a] - 1);
    origin += image.direction.col(f) * image.spacing[f] * (size[a] - 1);
  }
  Volume<float> out(size, spacing, origin);
  std::size_t n = 0;
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        out.values[n++] = image.values[start + i * step[0] + j * step[1] + k * step[2]];
  return out;
}

bool is_file_order(const AxisMap& map) {
  for (int a = 0; a < 3; ++a)
    if (map.file_axis[a] != a || map.reversed[a]) return false;
  return true;
}

/// Value at a continuous file index; 0 outside.
float value_at(const GridImage& image, const Eigen::Vector3d& index, Between between) {
  const auto voxel = [&](const Eigen::Vector3i& v) -> float {
    if ((v.array() < 0).any() || (v.array() >= image.size.array()).any()) return 0;
    return image
        .values[(static_cast<std::size_t>(v.z()) * image.size.y() + v.y()) * image.size.x() +
                v.x()];
  };
  if (between == Between::nearest) return voxel(index.array().round().cast<int>());
  const Eigen::Vector3i low = index.array().floor().cast<int>();
  const Eigen::Vector3d t = index - low.cast<double>();
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i bit(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    double weight = 1;
    for (int a = 0; a < 3; ++a) weight *= bit[a] ? t[a] : 1 - t[a];
    if (weight > 0) sum += weight * voxel(low + bit);
  }
  return static_cast<float>(sum);
}

Volume<float> resampled(const GridImage& image, const AxisMap& map, Between between) {
  const Eigen::Vector3d extent = (image.size.array() - 1).cast<double>() * image.spacing.array();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e30), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d t(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    const Eigen::Vector3d x = image.origin + image.direction * t.cwiseProduct(extent);
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  Eigen::Vector3d spacing;
  for (int a = 0; a < 3; ++a) spacing[a] = image.spacing[map.file_axis[a]];
  const Eigen::Vector3i size = ((high - low).cwiseQuotient(spacing).array().ceil() + 1).cast<int>();
  Volume<float> out(size, spacing, low);
  const Eigen::Matrix3d index_from_lps =
      image.spacing.cwiseInverse().asDiagonal() * image.direction.transpose();
  std::size_t n = 0;
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        out.values[n++] =
            value_at(image, index_from_lps * (out.position(i, j, k) - image.origin), between);
  return out;
}

}  // namespace

Volume<float> to_lps_grid(GridImage image, Between between, std::vector<std::string>& notes) {
  check_orthogonal(image.direction);
  const AxisMap map = nearest_axes(image.direction);
  if (map.deviation_degrees > aligned_within_degrees) {
    std::ostringstream note;
    note.precision(3);
    note << "the image is oblique by " << map.deviation_degrees
         << " degrees and was resampled to axes along left, posterior and superior";
    notes.push_back(note.str());
    return resampled(image, map, between);
  }
  if (!is_file_order(map)) return permuted(image, map);
  Volume<float> out;
  out.size = image.size;
  out.spacing = image.spacing;
  out.origin = image.origin;
  out.values = std::move(image.values);
  return out;
}

}  // namespace mammotwin
