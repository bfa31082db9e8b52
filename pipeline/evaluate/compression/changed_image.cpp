#include "pipeline/evaluate/compression/changed_image.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "pipeline/evaluate/cases/spline_resampled.h"
#include "segmentation/image/flipped.h"

namespace mammotwin {
namespace {

std::uint16_t label_at(const Volume<std::uint16_t>& labels, const Eigen::Vector3d& x) {
  const Eigen::Vector3d index = labels.index(x), low = index.array().floor();
  std::vector<std::pair<std::uint16_t, double>> shares;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d step(corner & 1, corner >> 1 & 1, corner >> 2);
    const Eigen::Vector3i at = (low + step).cast<int>();
    const double share =
        (1 - (index - low - step).array().abs()).prod();  // falls to 0 one voxel away
    const std::uint16_t label =
        labels.contains(at.x(), at.y(), at.z()) ? labels(at.x(), at.y(), at.z()) : 0;
    const auto known =
        std::find_if(shares.begin(), shares.end(), [&](auto& s) { return s.first == label; });
    if (known == shares.end())
      shares.emplace_back(label, share);
    else
      known->second += share;
  }
  return std::max_element(shares.begin(), shares.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// On another grid, whose place x shows what stands at `from(x)`.
template <class From>
Volume<float> resampled(const Volume<float>& image, Volume<float> onto, From from) {
  return spline_resampled(image, std::move(onto), from);
}

template <class From>
Volume<std::uint16_t> resampled(const Volume<std::uint16_t>& labels, Volume<std::uint16_t> onto,
                                From from) {
  for (int k = 0; k < onto.size.z(); ++k)
    for (int j = 0; j < onto.size.y(); ++j)
      for (int i = 0; i < onto.size.x(); ++i)
        onto(i, j, k) = label_at(labels, from(onto.position(i, j, k)));
  return onto;
}

/// Turned on a grid that holds all of it, then back on its own.
template <class T>
Volume<T> turned_and_back(const Volume<T>& image, double deg) {
  const Eigen::Matrix3d turn(
      Eigen::AngleAxisd(deg * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector3d extent = image.spacing.cwiseProduct(image.size.template cast<double>());
  const Eigen::Vector3d middle = image.origin + (extent - image.spacing) / 2;
  const double margin = std::abs(std::sin(deg * std::numbers::pi / 180)) * extent.maxCoeff() / 2;
  const Eigen::Vector3d more(std::ceil(margin / image.spacing.x()),
                             std::ceil(margin / image.spacing.y()), 0);
  const Volume<T> wide(image.size + 2 * more.cast<int>(), image.spacing,
                       image.origin - image.spacing.cwiseProduct(more));
  const Volume<T> there = resampled(image, wide, [&](const Eigen::Vector3d& x) {
    return (middle + turn.transpose() * (x - middle)).eval();
  });
  return resampled(there, image,
                   [&](const Eigen::Vector3d& x) { return (middle + turn * (x - middle)).eval(); });
}

template <class T>
Volume<T> half_a_voxel_off(const Volume<T>& image) {
  const Volume<T> grid(image.size - Eigen::Vector3i::Ones(), image.spacing,
                       image.origin + image.spacing / 2);
  return resampled(image, grid, [](const Eigen::Vector3d& x) { return x; });
}

template <class T>
Volume<T> changed(const Volume<T>& image, const InputChange& change) {
  if (change.turn_deg != 0) return turned_and_back(image, change.turn_deg);
  if (change.mirror) return flipped(image);
  if (change.half_voxel) return half_a_voxel_off(image);
  return image;
}

}  // namespace

const std::vector<InputChange>& input_changes() {
  static const std::vector<InputChange> all = {
      {.name = "turn_1", .turn_deg = 1},          {.name = "turn_3", .turn_deg = 3},
      {.name = "turn_5", .turn_deg = 5},          {.name = "mirror", .mirror = true},
      {.name = "half_voxel", .half_voxel = true}, {.name = "elements", .more_elements = 1},
      {.name = "thickness", .thicker_mm = 0.1}};
  return all;
}

Volume<std::uint16_t> changed_image(const Volume<std::uint16_t>& labels,
                                    const InputChange& change) {
  return changed(labels, change);
}

Volume<float> changed_image(const Volume<float>& grey, const InputChange& change) {
  return changed(grey, change);
}

}  // namespace mammotwin
