#pragma once

#include <cstdint>

#include "segmentation/volume.h"

namespace mammotwin {

/// Standard deviation of the noise in a part of an image [image units], by its finest detail: the
/// differences over the diagonals of cubes of 2 x 2 x 2 voxels, of which few hold an edge; their
/// median absolute value over 0.6745 (Donoho and Johnstone, Biometrika 81 (1994), 425-455). 0 where
/// no cube lies within `where`; less than the noise of an image that was interpolated.
double noise_of_detail(const Volume<float>& image, const Volume<std::uint8_t>& where);

/// The image with noise of standard deviation `noise` averaged out where it hides no edge: a
/// bilateral filter (Tomasi and Manduchi, ICCV 1998, 839-846) over the 57 voxels within 2.3 of
/// each, Gaussians of 1.2 voxels and twice the noise. Leaves an image alone whose noise is far
/// below its contrasts.
Volume<float> denoised(const Volume<float>& image, double noise);

}  // namespace mammotwin
