#include "segmentation/fibroglandular.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "segmentation/distance.h"
#include "segmentation/smoothing.h"

namespace mammotwin {
namespace {

constexpr double refit_mm = 10;
constexpr std::size_t least_voxels = 200;  // fewer give no median worth the name

double median_where(const Volume<float>& image, const Volume<std::uint8_t>& mask) {
  std::vector<float> values;
  for (std::size_t v = 0; v < mask.values.size(); ++v)
    if (mask.values[v]) values.push_back(image.values[v]);
  if (values.size() < least_voxels) return 0;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Otsu's threshold over the mask, in 256 bins up to the 99.5th percentile.
double otsu(const Volume<float>& image, const Volume<std::uint8_t>& mask) {
  std::vector<float> values;
  for (std::size_t v = 0; v < mask.values.size(); ++v)
    if (mask.values[v]) values.push_back(image.values[v]);
  if (values.empty()) return 0;
  const std::size_t top = values.size() * 995 / 1000;
  std::nth_element(values.begin(), values.begin() + top, values.end());
  const double high = std::max(values[top], 1e-6F);
  constexpr int bins = 256;
  std::array<double, bins> histogram{};
  for (const float value : values)
    ++histogram[static_cast<int>(std::clamp(value / high, 0.0, 1.0) * (bins - 1))];
  double total = 0, moment = 0;
  for (int b = 0; b < bins; ++b) total += histogram[b], moment += b * histogram[b];
  double below = 0, moment_below = 0, best = -1;
  int threshold = 0;
  for (int b = 0; b < bins - 1; ++b) {
    below += histogram[b], moment_below += b * histogram[b];
    if (below == 0 || below == total) continue;
    const double gap = moment_below / below - (moment - moment_below) / (total - below);
    const double between = below * (total - below) * gap * gap;
    if (between > best) best = between, threshold = b;
  }
  return (threshold + 1) * high / (bins - 1);
}

/// Interior voxels on one side of a threshold, without the outermost voxel of each part.
Volume<std::uint8_t> eroded_class(const Volume<float>& image, const Volume<std::uint8_t>& mask,
                                  double threshold, bool above) {
  auto in_class = mask.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < mask.values.size(); ++v)
    in_class.values[v] = mask.values[v] && (image.values[v] > threshold) == above;
  return eroded(in_class, mask.spacing.minCoeff() * 1.01);
}

/// Divides the image by the smoothed ratio of eroded fat to its median.
Volume<float> without_bias_of(const Volume<float>& image, const Volume<std::uint8_t>& fat,
                              double fat_median) {
  auto log_ratio = image.like<float>(0), weight = log_ratio;
  for (std::size_t v = 0; v < image.values.size(); ++v) {
    if (!fat.values[v] || !(image.values[v] > 0)) continue;
    log_ratio.values[v] =
        static_cast<float>(std::clamp(std::log(image.values[v] / fat_median), -0.5, 0.5));
    weight.values[v] = 1;
  }
  // Smoothed on blocks: the field is 10 mm wide.
  auto fat_mask = fat;
  Volume<float> share;
  const Eigen::Vector3i factor = (3 / image.spacing.array()).round().max(1).cast<int>().matrix();
  const Volume<float> coarse = block_means(log_ratio, fat_mask, factor, share);
  const Volume<float> field = weighted_smoothed(coarse, share, refit_mm);
  Volume<float> out = image;
  for (int k = 0; k < out.size.z(); ++k)
    for (int j = 0; j < out.size.y(); ++j)
      for (int i = 0; i < out.size.x(); ++i)
        if (out(i, j, k) != 0)
          out(i, j, k) *= std::exp(-interpolated(field, out.position(i, j, k)));
  return out;
}

}  // namespace

TissueSplit split_tissue(const Volume<float>& image, const Volume<std::uint8_t>& interior,
                         const Volume<std::uint8_t>& statistics, bool fat_suppressed) {
  const bool gland_above = fat_suppressed;
  // Brightness of gland over fat where the breast holds too little of it to be measured (study).
  const double usual_gland = fat_suppressed ? 1.8 : 0.45;
  const double threshold = otsu(image, statistics);
  const auto fat_mask = eroded_class(image, statistics, threshold, !gland_above);
  const double fat_median = std::max(1e-6, median_where(image, fat_mask));

  TissueSplit split;
  split.corrected = without_bias_of(image, fat_mask, fat_median);
  for (float& value : split.corrected.values) value /= static_cast<float>(fat_median);
  // Fat again in the corrected image, and gland against it. Pure gland is what stays after
  // erosion beyond the middle between the classes; a few rounds settle the threshold.
  split.fat = std::max(1e-6, median_where(split.corrected, fat_mask));
  split.gland = usual_gland * split.fat;
  double middle = threshold / fat_median;
  for (int round = 0; round < 3; ++round) {
    const auto gland = eroded_class(split.corrected, statistics, middle, gland_above);
    const double median = median_where(split.corrected, gland);
    const bool usable =
        gland_above ? median > 1.15 * split.fat : median > 0 && median < 0.85 * split.fat;
    split.gland = usable ? median : usual_gland * split.fat;
    middle = (split.fat + split.gland) / 2;
  }
  split.gland_fraction = image.like<float>(0);
  for (std::size_t v = 0; v < image.values.size(); ++v)
    if (interior.values[v])
      split.gland_fraction.values[v] = static_cast<float>(std::clamp(
          (split.corrected.values[v] - split.fat) / (split.gland - split.fat), 0.0, 1.0));
  return split;
}

}  // namespace mammotwin
