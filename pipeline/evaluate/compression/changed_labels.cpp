#include "pipeline/evaluate/compression/changed_labels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace mammotwin {
namespace {

using LabelVolume = Volume<std::uint16_t>;

std::uint16_t label_at(const LabelVolume& labels, const Eigen::Vector3d& x) {
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
LabelVolume resampled(const LabelVolume& labels, LabelVolume onto, From from) {
  for (int k = 0; k < onto.size.z(); ++k)
    for (int j = 0; j < onto.size.y(); ++j)
      for (int i = 0; i < onto.size.x(); ++i)
        onto(i, j, k) = label_at(labels, from(onto.position(i, j, k)));
  return onto;
}

/// Turned on a grid that holds all of it, then back on its own.
LabelVolume turned_and_back(const LabelVolume& labels, double deg) {
  const Eigen::Matrix3d turn(
      Eigen::AngleAxisd(deg * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector3d extent = labels.spacing.cwiseProduct(labels.size.cast<double>());
  const Eigen::Vector3d middle = labels.origin + (extent - labels.spacing) / 2;
  const double margin = std::abs(std::sin(deg * std::numbers::pi / 180)) * extent.maxCoeff() / 2;
  const Eigen::Vector3d more(std::ceil(margin / labels.spacing.x()),
                             std::ceil(margin / labels.spacing.y()), 0);
  const LabelVolume wide(labels.size + 2 * more.cast<int>(), labels.spacing,
                         labels.origin - labels.spacing.cwiseProduct(more));
  const LabelVolume there = resampled(labels, wide, [&](const Eigen::Vector3d& x) {
    return (middle + turn.transpose() * (x - middle)).eval();
  });
  return resampled(there, labels,
                   [&](const Eigen::Vector3d& x) { return (middle + turn * (x - middle)).eval(); });
}

LabelVolume mirrored(const LabelVolume& labels) {
  LabelVolume result = labels;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i)
        result(i, j, k) = labels(labels.size.x() - 1 - i, j, k);
  return result;
}

LabelVolume half_a_voxel_off(const LabelVolume& labels) {
  const LabelVolume grid(labels.size - Eigen::Vector3i::Ones(), labels.spacing,
                         labels.origin + labels.spacing / 2);
  return resampled(labels, grid, [](const Eigen::Vector3d& x) { return x; });
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

LabelVolume changed_labels(const LabelVolume& labels, const InputChange& change) {
  if (change.turn_deg != 0) return turned_and_back(labels, change.turn_deg);
  if (change.mirror) return mirrored(labels);
  if (change.half_voxel) return half_a_voxel_off(labels);
  return labels;
}

double mirror_plane(const LabelVolume& labels) {
  return labels.origin.x() + labels.spacing.x() * (labels.size.x() - 1) / 2;
}

}  // namespace mammotwin
