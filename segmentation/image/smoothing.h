#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// Convolved with a Gaussian of standard deviation `sigma` mm, cut at 3 sigma; zero outside. Our
/// own: at 0.4 to 8 mm on 1.2 mm voxels ITK's DiscreteGaussianImageFilter takes 1.7 to 13 times the
/// processor time, and its kernel (of Bessel functions) differs by 1.7 % at half a voxel's width;
/// its recursive filter has no zero outside.
Volume<float> gaussian_smoothed(Volume<float> image, double sigma);

/// Weighted local mean: smoothed(weight * image) / smoothed(weight); 0 where there is no weight
/// within reach.
Volume<float> weighted_smoothed(const Volume<float>& image, const Volume<float>& weight,
                                double sigma);

/// Largest value in the cube of 2 n + 1 voxels a side.
Volume<float> local_maximum(Volume<float> image, int n);

/// Trilinear value at a point [mm]; beyond the grid the nearest face's value. In single precision,
/// unlike trilinear.h: it is asked for every voxel of whole images.
float interpolated(const Volume<float>& image, const Eigen::Vector3d& x_in_lps);

/// A coarser grid of blocks of whole voxels, about `block_mm` a side: mean over the voxels in the
/// mask. `share` receives the part of each block that lies in the mask.
Volume<float> block_means(const Volume<float>& image, const Volume<std::uint8_t>& mask,
                          double block_mm, Volume<float>& share);

/// The local mean over the mask as a field `sigma` mm wide, on such blocks; 0 where nothing of the
/// mask is within reach.
Volume<float> smooth_field(const Volume<float>& image, const Volume<std::uint8_t>& mask,
                           double block_mm, double sigma);

}  // namespace mammotwin
