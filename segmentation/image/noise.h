#pragma once

#include <cstdint>
#include <optional>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// Standard deviation of the noise in a part of an image [image units], by its finest detail: the
/// differences over the diagonals of cubes of two voxels a side, `step` apart, of which few hold
/// an edge; their median absolute value over 0.6745 (Donoho and Johnstone, Biometrika 81 (1994),
/// 425-455). 0 where no cube lies within `where`. Of an image whose noise is correlated from voxel
/// to voxel a `step` of 1 sees only a part.
double noise_of_detail(const Volume<float>& image, const Volume<std::uint8_t>& where, int step = 1);

/// Correlation of the noise of voxels beside each other, in the mean over the axes: the median of
/// cubes of 8 voxels a side that hold no body and no zero. Near 0 as a scanner's coils give it,
/// more where its software interpolated or filtered. Of magnitudes in air, so about the square of
/// that in the body. None where the air was blanked or there is little of it.
std::optional<double> noise_correlation(const Volume<float>& image,
                                        const Volume<std::uint8_t>& body);

}  // namespace mammotwin
