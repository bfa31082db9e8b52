#include "segmentation/body/half_body.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "segmentation/body/apices.h"
#include "segmentation/image/components.h"

namespace mammotwin {

std::optional<double> find_midline(const Volume<std::uint8_t>& labels) {
  std::vector<double> front(labels.size.x(), -std::numeric_limits<double>::infinity());
  for (int k = 0; k < labels.size.z(); ++k)
    for (int i = 0; i < labels.size.x(); ++i)
      for (int j = 0; j < labels.size.y(); ++j) {
        if (!label::is_breast(labels(i, j, k))) continue;
        front[i] = std::max(front[i], -labels.position(i, j, k).y());
        break;
      }
  // Columns beyond the body are no valley: only what lies between finite values counts.
  const auto apices = find_apices(front, labels.spacing.x());
  if (!apices) return std::nullopt;
  return labels.position(apices->valley, 0, 0).x();
}

bool is_on_side(double x, double midline, Side side) {
  return side == Side::left ? x >= midline : x <= midline;
}

void keep_side(Volume<std::uint8_t>& labels, double midline, Side side) {
  for (int i = 0; i < labels.size.x(); ++i) {
    if (is_on_side(labels.position(i, 0, 0).x(), midline, side)) continue;
    for (int k = 0; k < labels.size.z(); ++k)
      for (int j = 0; j < labels.size.y(); ++j) labels(i, j, k) = label::air;
  }
}

void fill_behind_muscle(Volume<std::uint8_t>& labels) {
  constexpr std::size_t least_muscle = 2000;
  auto muscle = labels.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < labels.values.size(); ++v)
    muscle.values[v] = labels.values[v] == label::muscle;
  const auto front = without_small_components(muscle, least_muscle);
  for (int k = 0; k < labels.size.z(); ++k)
    for (int i = 0; i < labels.size.x(); ++i) {
      bool behind = false;
      for (int j = 0; j < labels.size.y(); ++j) {
        std::uint8_t& value = labels(i, j, k);
        behind = behind || front(i, j, k);
        if (behind && !label::is_lesion(value)) value = label::muscle;
        if (!behind && value == label::muscle) value = label::fat;
      }
    }
}

VoxelBox labelled_box(const Volume<std::uint8_t>& labels, int margin) {
  VoxelBox box{labels.size, Eigen::Vector3i::Constant(-1)};
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        if (labels(i, j, k) == label::air) continue;
        box.low = box.low.cwiseMin(Eigen::Vector3i(i, j, k));
        box.high = box.high.cwiseMax(Eigen::Vector3i(i, j, k));
      }
  box.low = (box.low.array() - margin).max(0);
  box.high = (box.high.array() + margin).min(labels.size.array() - 1);
  return box;
}

}  // namespace mammotwin
