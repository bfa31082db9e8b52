#include "segmentation/score.h"

#include <algorithm>
#include <vector>

#include "segmentation/distance.h"
#include "segmentation/half_body.h"

namespace mammotwin {
namespace {

using Mask = Volume<std::uint8_t>;

template <class Keep>
Mask where(const Mask& labels, const Keep& keep) {
  auto out = labels.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < out.values.size(); ++v) out.values[v] = keep(labels.values[v]);
  return out;
}

Mask cropped_to_region(const Mask& labels, const BreastRegion& region) {
  Eigen::Vector3i low = labels.size, high = Eigen::Vector3i::Constant(-1);
  for (int k = 0; k < labels.size.z(); ++k)
    for (int i = 0; i < labels.size.x(); ++i)
      if (region.contains(labels.position(i, 0, k))) {
        low = low.cwiseMin(Eigen::Vector3i(i, 0, k));
        high = high.cwiseMax(Eigen::Vector3i(i, labels.size.y() - 1, k));
      }
  return cropped(labels, low, high);
}

/// The labels of `from` at the voxel centres of `grid`; air outside.
Mask labels_on(const Mask& grid, const Mask& from) {
  auto out = grid.like<std::uint8_t>(label::air);
  for (int k = 0; k < grid.size.z(); ++k)
    for (int j = 0; j < grid.size.y(); ++j)
      for (int i = 0; i < grid.size.x(); ++i) {
        const Eigen::Vector3i v = from.index(grid.position(i, j, k)).array().round().cast<int>();
        if (from.contains(v.x(), v.y(), v.z())) out(i, j, k) = from(v.x(), v.y(), v.z());
      }
  return out;
}

/// Breast voxels that touch `other` across a face, `inset` voxels and more from the lateral faces
/// of the grid.
Mask border_with(const Mask& labels, std::uint8_t other, int inset) {
  auto out = labels.like<std::uint8_t>(0);
  const auto is_other = [&](int a, int b, int c) {
    return labels.contains(a, b, c) && labels(a, b, c) == other;
  };
  for (int k = inset; k < labels.size.z() - inset; ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = inset; i < labels.size.x() - inset; ++i)
        out(i, j, k) = label::is_breast(labels(i, j, k)) &&
                       (is_other(i - 1, j, k) || is_other(i + 1, j, k) || is_other(i, j - 1, k) ||
                        is_other(i, j + 1, k) || is_other(i, j, k - 1) || is_other(i, j, k + 1));
  return out;
}

void score_lesions(const Segmentation& truth, const Segmentation& found, const Mask& a,
                   const Mask& b, SegmentationScore& score) {
  for (std::size_t n = 0; n < std::min(truth.lesions.size(), found.lesions.size()); ++n) {
    const auto is_this = [&](std::uint8_t value) { return value == label::lesion + n; };
    const double overlap = dice(where(a, is_this), where(b, is_this)).value_or(0);
    const double off = (truth.lesions[n].centroid_in_lps - found.lesions[n].centroid_in_lps).norm();
    score.lesion_dice = std::min(score.lesion_dice.value_or(1), overlap);
    score.lesion_centroid_mm = std::max(score.lesion_centroid_mm.value_or(0), off);
  }
}

}  // namespace

std::optional<double> dice(const Mask& a, const Mask& b) {
  double both = 0, sum = 0;
  for (std::size_t v = 0; v < a.values.size(); ++v) {
    both += a.values[v] && b.values[v];
    sum += (a.values[v] != 0) + (b.values[v] != 0);
  }
  if (sum == 0) return std::nullopt;
  return 2 * both / sum;
}

std::optional<SurfaceDistance> surface_distance(const Mask& a, const Mask& b) {
  const Volume<float> to_a = distance_to(a), to_b = distance_to(b);
  std::vector<double> distances;
  std::size_t on_a = 0, on_b = 0;
  for (std::size_t v = 0; v < a.values.size(); ++v) {
    if (a.values[v]) distances.push_back(to_b.values[v]), ++on_a;
    if (b.values[v]) distances.push_back(to_a.values[v]), ++on_b;
  }
  if (on_a == 0 || on_b == 0) return std::nullopt;
  std::sort(distances.begin(), distances.end());
  SurfaceDistance d;
  for (const double x : distances) d.mean += x / static_cast<double>(distances.size());
  d.median = distances[distances.size() / 2];
  d.p95 = distances[distances.size() * 95 / 100];
  d.largest = distances.back();
  return d;
}

SegmentationScore score_segmentation(const Segmentation& truth, const Segmentation& found) {
  const Mask a = cropped_to_region(truth.labels, truth.region);
  const Mask b = labels_on(a, found.labels);
  const auto is = [](std::uint8_t wanted) {
    return [wanted](std::uint8_t value) { return value == wanted; };
  };
  SegmentationScore score;
  score.breast_dice = dice(where(a, label::is_breast), where(b, label::is_breast));
  score.skin_dice = dice(where(a, is(label::skin)), where(b, is(label::skin)));
  score.fibroglandular_dice =
      dice(where(a, is(label::fibroglandular)), where(b, is(label::fibroglandular)));
  constexpr double inset_mm = 5;
  const int inset = static_cast<int>(inset_mm / a.spacing.minCoeff());
  score.chest_wall =
      surface_distance(border_with(a, label::muscle, inset), border_with(b, label::muscle, inset));
  score.skin_surface =
      surface_distance(border_with(a, label::air, inset), border_with(b, label::air, inset));
  score_lesions(truth, found, a, b, score);
  score.nipple_mm = (truth.nipple_in_lps - found.nipple_in_lps).norm();
  return score;
}

}  // namespace mammotwin
