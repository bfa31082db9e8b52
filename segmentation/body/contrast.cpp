#include "segmentation/body/contrast.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "segmentation/image/em_bias.h"
#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

constexpr double reach_behind_sternum_mm = 40;  // the chest beside the breasts counts too
constexpr double fat_from_mm = 5, fat_to_mm = 8.5;
constexpr double skin_from_mm = 0.5, skin_to_mm = 2, under_from_mm = 2.5, under_to_mm = 4.5;
constexpr double bin_mm = 0.5;
constexpr int num_classes = 4;  // as for the chest wall
constexpr double brighter_than_fat = 1.15, darker_than_fat = 0.75, lung_over_fat = 0.28;
// 90 synthetic images, skin of 1 to 3 mm, noise 3 to 8 %: 0.947 to 1.6 where fat is suppressed,
// 0.50 to 0.95 where it is not; a real one 1.6.
constexpr double suppressed_above = 0.96;

/// Value below which `share` of the image lies at a depth below the front's skin; 0 for nothing.
double quantile_at(const Volume<float>& image, const Volume<float>& depth, const BreastFrame& frame,
                   double from, double to, double share) {
  std::vector<float> values;
  for (int k = 0; k < image.size.z(); ++k) {
    const double z = image.position(0, 0, k).z();
    if (z < frame.z_low || z > frame.z_high) continue;
    for (int j = 0; j < image.size.y(); ++j) {
      if (image.position(0, j, k).y() > frame.sternal_y + reach_behind_sternum_mm) break;
      for (int i = 0; i < image.size.x(); ++i)
        if (depth(i, j, k) >= from && depth(i, j, k) < to) values.push_back(image(i, j, k));
    }
  }
  if (values.empty()) return 0;
  return quantile(values, share);
}

double brightest_bin(const Volume<float>& image, const Volume<float>& depth,
                     const BreastFrame& frame, double from, double to) {
  double brightest = 0;
  for (; from < to; from += bin_mm)
    brightest = std::max(brightest, quantile_at(image, depth, frame, from, from + bin_mm, 0.5));
  return brightest;
}

}  // namespace

Contrast find_contrast(const Volume<float>& image, const Volume<float>& depth,
                       const BreastFrame& frame) {
  const double skin = brightest_bin(image, depth, frame, skin_from_mm, skin_to_mm);
  const double under = brightest_bin(image, depth, frame, under_from_mm, under_to_mm);
  Contrast contrast;
  contrast.skin_over_fat = skin / std::max(under, 1e-6);
  contrast.fat_suppressed = contrast.skin_over_fat > suppressed_above;
  return contrast;
}

Volume<float> depth_where_thin(const Volume<float>& depth, double thick_mm) {
  constexpr double steepest = 0.6;  // of the skin's normal along a thick voxel
  constexpr float least = 1e-6F;
  Volume<float> seen = depth.like<float>(0);
  for (int k = 1; k + 1 < depth.size.z(); ++k)
    for (int j = 1; j + 1 < depth.size.y(); ++j)
      for (int i = 1; i + 1 < depth.size.x(); ++i) {
        const Eigen::Vector3d slope = Eigen::Vector3d(depth(i + 1, j, k) - depth(i - 1, j, k),
                                                      depth(i, j + 1, k) - depth(i, j - 1, k),
                                                      depth(i, j, k + 1) - depth(i, j, k - 1))
                                          .cwiseQuotient(depth.spacing);
        const Eigen::Array3d normal = slope.array().abs() / std::max<double>(slope.norm(), least);
        if ((normal <= steepest || depth.spacing.array() <= thick_mm).all())
          seen(i, j, k) = depth(i, j, k);
      }
  return seen;
}

bool is_fat_outshone(const Volume<float>& image, const Volume<std::uint8_t>& body,
                     const Volume<float>& depth, const BreastFrame& frame) {
  const BiasEstimate bias = estimate_bias(image, body, num_classes);
  Volume<float> corrected = image;
  tbb::parallel_for(0, image.size.z(), [&](int k) {
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i)
        corrected(i, j, k) *= bias.correction(image.position(i, j, k));
  });
  const double fat = quantile_at(corrected, depth, frame, fat_from_mm, fat_to_mm, 0.5);
  double brighter = 0, darker = 0;
  for (const IntensityClass& c : bias.classes) {
    const double over_fat = std::exp(c.mean) / std::max(fat, 1e-6);
    if (over_fat > brighter_than_fat) brighter += c.weight;
    if (over_fat > lung_over_fat && over_fat < darker_than_fat) darker += c.weight;
  }
  return brighter > darker;
}

double subcutaneous_fat(const Volume<float>& image, const Volume<float>& depth,
                        const BreastFrame& frame, bool fat_suppressed) {
  const double fat =
      quantile_at(image, depth, frame, fat_from_mm, fat_to_mm, fat_suppressed ? 0.3 : 0.7);
  if (!(fat > 0))
    throw std::runtime_error(
        "no breast found: there is nothing 5 to 8.5 mm under its skin; "
        "expected a prone breast MRI");
  return fat;
}

}  // namespace mammotwin
