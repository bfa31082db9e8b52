#include "segmentation/shading/flank_shading.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

constexpr double layer_from_mm = 4, layer_to_mm = 7;
constexpr double layer_block_mm = 4, smoothing_mm = 15;
constexpr double from_mm = 20, full_mm = 40;  // behind the skin between the breasts
constexpr float darkest = 0.2F;

/// Brightness of the layer round every block; 1 far from it.
Volume<float> layer_brightness(const Volume<float>& image, const Volume<float>& depth) {
  auto layer = depth.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < depth.values.size(); ++v)
    layer.values[v] = depth.values[v] > layer_from_mm && depth.values[v] < layer_to_mm;
  Volume<float> brightness = smooth_field(image, layer, layer_block_mm, smoothing_mm);
  std::replace(brightness.values.begin(), brightness.values.end(), 0.0F, 1.0F);
  return brightness;
}

}  // namespace

Volume<float> flank_shading(const Volume<float>& image, const Volume<float>& depth,
                            const BreastFrame& frame) {
  const Volume<float> brightness = layer_brightness(image, depth);
  auto shading = image.like<float>(1);
  tbb::parallel_for(0, image.size.z(), [&](int k) {
    for (int j = 0; j < image.size.y(); ++j) {
      const double y = image.position(0, j, k).y();
      const double full = std::min(1.0, (y - frame.sternal_y - from_mm) / (full_mm - from_mm));
      if (full <= 0) continue;
      for (int i = 0; i < image.size.x(); ++i) {
        const float here = interpolated(brightness, image.position(i, j, k));
        shading(i, j, k) = static_cast<float>(std::pow(std::clamp(here, darkest, 1.0F), full));
      }
    }
  });
  return shading;
}

}  // namespace mammotwin
