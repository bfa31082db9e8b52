#pragma once

#include <optional>

#include "segmentation/contrast_agent/pre_match.h"
#include "segmentation/shading/half_images.h"

namespace mammotwin {

/// The image that tissue is told apart in, with the standard deviation of its noise.
struct TissueImage {
  Volume<float> image, noise;
};

/// The noisy image; or its mean with the one before contrast agent, unless the patient moved in
/// between (`match`). `noise_spread`: by how much the noise of far voxels exceeds that of
/// neighbours.
TissueImage tissue_image(const HalfImages& images, const std::optional<PreMatch>& match,
                         double noise_spread);

}  // namespace mammotwin
