#pragma once

#include "segmentation/image/volume.h"

namespace mammotwin {

/// The image with noise of standard deviation `noise` averaged out where it hides no edge: a
/// bilateral filter (Tomasi and Manduchi, ICCV 1998, 839-846) over the 57 voxels within 2.3 of
/// each, Gaussians of 1.2 voxels and twice the noise. Leaves an image alone whose noise is far
/// below its contrasts.
Volume<float> denoised(const Volume<float>& image, double noise);

}  // namespace mammotwin
