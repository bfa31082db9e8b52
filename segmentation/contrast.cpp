#include "segmentation/contrast.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace mammotwin {
namespace {

/// Value below which `share` of a layer's values lie.
double layer_quantile(const Volume<float>& image, const Volume<float>& depth,
                      const BreastFrame& frame, double from, double to, double share) {
  std::vector<float> values;
  for (int k = 0; k < image.size.z(); ++k) {
    const double z = image.position(0, 0, k).z();
    if (z < frame.z_low || z > frame.z_high) continue;
    for (int j = 0; j < image.size.y(); ++j) {
      if (image.position(0, j, k).y() > frame.sternal_y) break;
      for (int i = 0; i < image.size.x(); ++i)
        if (depth(i, j, k) >= from && depth(i, j, k) <= to) values.push_back(image(i, j, k));
    }
  }
  if (values.empty())
    throw std::runtime_error(
        "no breast found: nothing lies 6.5 to 13 mm under its skin; expected "
        "a prone breast MRI");
  const auto n = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + n, values.end());
  return values[static_cast<std::size_t>(n)];
}

}  // namespace

Contrast find_contrast(const Volume<float>& image, const Volume<float>& depth,
                       const BreastFrame& frame) {
  Contrast contrast;
  const double rim = layer_quantile(image, depth, frame, 0.5, 4.5, 0.7);
  contrast.rim_over_fat = rim / std::max(1e-6, subcutaneous_fat(image, depth, frame));
  contrast.fat_suppressed = contrast.rim_over_fat > 1;
  return contrast;
}

double subcutaneous_fat(const Volume<float>& image, const Volume<float>& depth,
                        const BreastFrame& frame) {
  return layer_quantile(image, depth, frame, 6.5, 13, 0.5);
}

}  // namespace mammotwin
