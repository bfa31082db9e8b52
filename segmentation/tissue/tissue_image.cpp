#include "segmentation/tissue/tissue_image.h"

#include <cmath>

namespace mammotwin {

TissueImage tissue_image(const HalfBreast& half) {
  TissueImage scan{half.scan, half.noise};
  double noise = half.noise_spread;
  if (half.pre_match && !half.pre_match->moved()) {
    const double scale = half.pre_match->scale;
    scan.image = mean_with_pre(std::move(scan.image), half.pre, scale);
    noise *= std::sqrt(1 + scale * scale) / 2;
  }
  for (float& value : scan.noise.values) value *= static_cast<float>(noise);
  return scan;
}

}  // namespace mammotwin
