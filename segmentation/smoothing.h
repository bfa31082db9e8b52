#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "segmentation/volume.h"

namespace mammotwin {

/// Convolved with a Gaussian of standard deviation `sigma` mm, cut at 3 sigma; zero outside.
Volume<float> gaussian_smoothed(Volume<float> image, double sigma);

/// Weighted local mean: smoothed(weight * image) / smoothed(weight); 0 where there is no weight
/// within reach.
Volume<float> weighted_smoothed(const Volume<float>& image, const Volume<float>& weight,
                                double sigma);

/// Largest value in the cube of 2 n + 1 voxels a side.
Volume<float> local_maximum(Volume<float> image, int n);

/// Trilinear value at a point [mm]; beyond the grid the nearest face's value.
float interpolated(const Volume<float>& image, const Eigen::Vector3d& x_in_lps);

/// A coarser grid of blocks of `factor` voxels: mean over the voxels in the mask. `share` receives
/// the part of each block that lies in the mask.
Volume<float> block_means(const Volume<float>& image, const Volume<std::uint8_t>& mask,
                          const Eigen::Vector3i& factor, Volume<float>& share);

}  // namespace mammotwin
