#include "segmentation/tissue/fibroglandular.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/image/distance.h"
#include "segmentation/image/masked.h"
#include "segmentation/image/otsu.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/tissue/fraction_noise.h"

namespace mammotwin {
namespace {

using Mask = Volume<std::uint8_t>;

constexpr double refit_mm = 10;
constexpr std::size_t least_voxels = 200;  // fewer give no median worth the name
constexpr float brightest_gland = 2.5;     // of fat; vessels and lesions are brighter

double median_where(const Volume<float>& image, const Mask& mask) {
  return median_in(image, mask, least_voxels);
}

/// Otsu's threshold over the mask, up to the 99.5th percentile.
double otsu(const Volume<float>& image, const Mask& mask) {
  std::vector<float> values = values_in(image, mask);
  if (values.empty()) return 0;
  constexpr double top = 0.995;
  const double high = std::max(quantile(values, top), 1e-6F);
  return otsu_threshold(values, high);
}

/// Interior voxels on one side of a threshold, without the outermost voxel of each part.
Mask eroded_class(const Volume<float>& image, const Mask& mask, double threshold, bool above) {
  auto in_class = mask.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < mask.values.size(); ++v)
    in_class.values[v] = mask.values[v] && (image.values[v] > threshold) == above;
  return eroded(in_class, mask.spacing.minCoeff() * 1.01);
}

/// What is known of the bias: log ratio of pure tissue to its brightness, and where.
struct PureTissue {
  Volume<float> log_ratio;
  Mask known;

  explicit PureTissue(const Volume<float>& image)
      : log_ratio(image.like<float>(0)), known(image.like<std::uint8_t>(0)) {}

  void add(const Volume<float>& image, const Mask& tissue, double brightness) {
    for (std::size_t v = 0; v < image.values.size(); ++v) {
      if (!tissue.values[v] || !(image.values[v] > 0)) continue;
      log_ratio.values[v] =
          static_cast<float>(std::clamp(std::log(image.values[v] / brightness), -0.5, 0.5));
      known.values[v] = 1;
    }
  }

  /// Divides the image by the smoothed ratio.
  void divide_out_of(Volume<float>& image) {
    constexpr double block_mm = 3;
    const Volume<float> field = smooth_field(log_ratio, known, block_mm, refit_mm);
    for (int k = 0; k < image.size.z(); ++k)
      for (int j = 0; j < image.size.y(); ++j)
        for (int i = 0; i < image.size.x(); ++i)
          if (image(i, j, k) != 0)
            image(i, j, k) *= std::exp(-interpolated(field, image.position(i, j, k)));
  }
};

/// Fat and gland of an image whose bias is being taken out.
class Split {
 public:
  Split(const Volume<float>& image, const Mask& statistics, bool fat_suppressed)
      : statistics_(statistics),
        gland_above_(fat_suppressed),
        usual_gland_(fat_suppressed ? 1.8 : 0.45),
        corrected_(image) {}

  /// From Otsu's threshold, with the bias of all that is darker or brighter and eroded.
  void start() {
    const double threshold = otsu(corrected_, statistics_);
    const Mask fat = eroded_class(corrected_, statistics_, threshold, !gland_above_);
    const double median = std::max(1e-6, median_where(corrected_, fat));
    PureTissue pure(corrected_);
    pure.add(corrected_, fat, median);
    pure.divide_out_of(corrected_);
    set_fat_to_one(fat);
    measure_gland(threshold / median);
  }

  /// The bias again, of what is near one of the pure tissues only: partial volume would pass for
  /// it, and where gland is dense little fat is left to tell it.
  void refit() {
    const Mask fat = near_pure(0), gland = near_pure(1);
    PureTissue pure(corrected_);
    pure.add(corrected_, fat, 1);
    if (gland_is_measured_) pure.add(corrected_, gland, gland_);
    pure.divide_out_of(corrected_);
    set_fat_to_one(near_pure(0));
    measure_gland((1 + gland_) / 2);
  }

  float fraction(std::size_t v) const {
    return static_cast<float>((corrected_.values[v] - 1) / (gland_ - 1));
  }
  double gland() const { return gland_; }
  Volume<float> corrected() && { return std::move(corrected_); }

 private:
  /// Voxels away from any of the other tissue, of a fraction within 0.2 of `pure` (0 or 1).
  Mask near_pure(int pure) const {
    constexpr double erode_at = 0.35, within = 0.2;
    const double at = pure ? 1 - erode_at : erode_at;
    Mask mask =
        eroded_class(corrected_, statistics_, 1 + at * (gland_ - 1), gland_above_ == (pure == 1));
    for (std::size_t v = 0; v < mask.values.size(); ++v)
      if (mask.values[v])
        mask.values[v] = std::abs(fraction(v) - static_cast<float>(pure)) < within;
    return mask;
  }

  void set_fat_to_one(const Mask& fat) {
    const double median = median_where(corrected_, fat);
    if (median <= 0) return;
    for (float& value : corrected_.values) value /= static_cast<float>(median);
  }

  /// Pure gland is what stays after erosion beyond the middle between the classes; a few rounds
  /// settle it. Where the breast holds too little to be measured, the usual brightness is taken.
  void measure_gland(double middle) {
    for (int round = 0; round < 3; ++round) {
      const double median = median_where(corrected_, pure_gland(middle));
      gland_is_measured_ = gland_above_ ? median > 1.15 : median > 0 && median < 0.85;
      gland_ = gland_is_measured_ ? median : usual_gland_;
      middle = (1 + gland_) / 2;
    }
  }

  Mask pure_gland(double threshold) const {
    Mask mask = eroded_class(corrected_, statistics_, threshold, gland_above_);
    for (std::size_t v = 0; v < mask.values.size(); ++v)
      mask.values[v] &= corrected_.values[v] < brightest_gland;
    return mask;
  }

  const Mask& statistics_;
  bool gland_above_, gland_is_measured_ = false;
  double usual_gland_, gland_ = 1;
  Volume<float> corrected_;
};

}  // namespace

TissueSplit split_tissue(const Volume<float>& image, const Volume<std::uint8_t>& interior,
                         const Volume<std::uint8_t>& statistics, bool fat_suppressed) {
  constexpr int rounds = 4;
  Split split(image, statistics, fat_suppressed);
  split.start();
  for (int round = 0; round < rounds; ++round) split.refit();

  TissueSplit result;
  result.gland_fraction = image.like<float>(0);
  for (std::size_t v = 0; v < image.values.size(); ++v)
    result.gland_fraction.values[v] = split.fraction(v);
  result.gland_fraction = without_noise(std::move(result.gland_fraction), interior, statistics);
  result.gland = split.gland();
  result.corrected = std::move(split).corrected();
  return result;
}

}  // namespace mammotwin
