#pragma once

#include "segmentation/chest_wall/half_breast.h"
#include "segmentation/shading/half_images.h"

namespace mammotwin {

/// The images with a finer bias taken out: that of the flank by its fat, then N4's in the breast,
/// away from skin and wall. Enhancement has no bias and stays.
HalfImages correct_shading(const HalfImages& images, const HalfBreast& half,
                           const BreastFrame& frame);

/// An image with 60 mm of bias taken out and the median of what lies in `where` at 1: keeps what is
/// local, as fat whose suppression failed.
Volume<float> widely_corrected(Volume<float> image, const Volume<float>& wide_log_bias,
                               const Volume<std::uint8_t>& where);

}  // namespace mammotwin
