#pragma once

#include "segmentation/body/half_breast.h"

namespace mammotwin {

/// The image that tissue is told apart in, with the standard deviation of its noise.
struct TissueImage {
  Volume<float> image, noise;
};

/// The scan; or its mean with the image before contrast agent, unless the patient moved in between.
TissueImage tissue_image(const HalfBreast& half);

}  // namespace mammotwin
