#include "segmentation/tissue/tissue_image.h"

#include <cmath>

namespace mammotwin {

TissueImage tissue_image(const HalfImages& images, const std::optional<PreMatch>& match,
                         double noise_spread) {
  TissueImage tissue{images.noisy, images.noise};
  double factor = noise_spread;
  if (match && !match->moved()) {
    tissue.image = mean_with_pre(std::move(tissue.image), images.pre, match->scale);
    factor *= std::sqrt(1 + match->scale * match->scale) / 2;
  }
  for (float& value : tissue.noise.values) value *= static_cast<float>(factor);
  return tissue;
}

}  // namespace mammotwin
