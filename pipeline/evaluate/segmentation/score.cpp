#include "pipeline/evaluate/segmentation/score.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/image/crop.h"
#include "segmentation/image/distance.h"

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

/// The values of `from` at the voxel centres of `grid`; zero (air) outside.
template <class Value>
Volume<Value> values_on(const Mask& grid, const Volume<Value>& from) {
  auto out = grid.like<Value>();
  for (int k = 0; k < grid.size.z(); ++k)
    for (int j = 0; j < grid.size.y(); ++j)
      for (int i = 0; i < grid.size.x(); ++i) {
        const Eigen::Vector3i v =
            from.index(grid.position(i, j, k)).array().round().template cast<int>();
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

/// Columns that hold true muscle, and whose neighbours do, as a mask.
Mask columns_with_muscle(const Mask& truth) {
  const int nx = truth.size.x(), nz = truth.size.z();
  std::vector<std::uint8_t> muscle(static_cast<std::size_t>(nx) * nz, 0);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < truth.size.y(); ++j)
      for (int i = 0; i < nx; ++i) muscle[k * nx + i] |= truth(i, j, k) == label::muscle;
  const auto has = [&](int i, int k) {
    return muscle[std::clamp(k, 0, nz - 1) * nx + std::clamp(i, 0, nx - 1)] != 0;
  };
  auto scored = truth.like<std::uint8_t>(0);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < truth.size.y(); ++j)
      for (int i = 0; i < nx; ++i)
        scored(i, j, k) =
            has(i, k) && has(i - 1, k) && has(i + 1, k) && has(i, k - 1) && has(i, k + 1);
  return scored;
}

Mask both(Mask a, const Mask& b) {
  for (std::size_t v = 0; v < a.values.size(); ++v) a.values[v] = a.values[v] && b.values[v];
  return a;
}

/// `scored` without the voxels that are half fibroglandular tissue in truth.
Mask off_half(Mask scored, const Segmentation& truth) {
  constexpr float within = 0.06F;
  const Volume<Fractions> fractions = values_on(scored, truth.fractions);
  for (std::size_t v = 0; v < scored.values.size(); ++v)
    scored.values[v] &= std::abs(fractions.values[v].fibroglandular - 0.5F) > within;
  return scored;
}

/// Compares the fractions at the voxels that are set in `scored`.
void score_fractions(const Segmentation& truth, const Segmentation& found, const Mask& scored,
                     SegmentationScore& score) {
  const Volume<Fractions> a = values_on(scored, truth.fractions);
  const Volume<Fractions> b = values_on(scored, found.fractions);
  double least = 0, true_sum = 0, found_sum = 0;
  for (std::size_t v = 0; v < scored.values.size(); ++v) {
    if (!scored.values[v]) continue;
    least += std::min(a.values[v].fibroglandular, b.values[v].fibroglandular);
    true_sum += a.values[v].fibroglandular, found_sum += b.values[v].fibroglandular;
  }
  if (true_sum == 0) return;
  score.fibroglandular_fraction_dice = 2 * least / (true_sum + found_sum);
  score.fibroglandular_volume_ratio = found_sum / true_sum;
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

SegmentationScore score_segmentation(const Segmentation& truth, const Segmentation& found,
                                     double fibroglandular_off_muscle_mm) {
  const Mask a = cropped_to_region(truth.labels, truth.region);
  const Mask b = values_on(a, found.labels);
  const auto is = [](std::uint8_t wanted) {
    return [wanted](std::uint8_t value) { return value == wanted; };
  };
  SegmentationScore score;
  const Mask scored = columns_with_muscle(a);
  const auto overlap = [&](const auto& keep) {
    return dice(both(where(a, keep), scored), both(where(b, keep), scored));
  };
  score.breast_dice = overlap(label::is_breast);
  score.skin_dice = overlap(is(label::skin));
  const Volume<float> off_muscle = distance_to(where(a, is(label::muscle)));
  auto apart = scored;
  for (std::size_t v = 0; v < apart.values.size(); ++v)
    apart.values[v] &=
        off_muscle.values[v] >= fibroglandular_off_muscle_mm && a.values[v] < label::lesion;
  const Mask true_gland = where(a, is(label::fibroglandular));
  const Mask found_gland = where(b, is(label::fibroglandular));
  const auto gland_overlap = [&](const Mask& mask) {
    return dice(both(true_gland, mask), both(found_gland, mask));
  };
  score.fibroglandular_dice = gland_overlap(apart);
  score.clear_fibroglandular_dice = gland_overlap(off_half(apart, truth));
  score_fractions(truth, found, apart, score);
  constexpr double inset_mm = 5;
  const int inset = static_cast<int>(inset_mm / a.spacing.minCoeff());
  const auto apart_by = [&](std::uint8_t other) {
    return surface_distance(both(border_with(a, other, inset), scored),
                            both(border_with(b, other, inset), scored));
  };
  score.chest_wall = apart_by(label::muscle);
  score.skin_surface = apart_by(label::air);
  score_lesions(truth, found, a, b, score);
  score.nipple_mm = (truth.nipple_in_lps - found.nipple_in_lps).norm();
  return score;
}

}  // namespace mammotwin
