#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// An image as a file holds it: any orientation of the voxel axes in patient LPS.
struct GridImage {
  Eigen::Vector3i size = Eigen::Vector3i::Zero();
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();  ///< [mm]
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();   ///< centre of voxel (0, 0, 0) in LPS [mm]
  Eigen::Matrix3d direction = Eigen::Matrix3d::Identity();  ///< column a: unit axis a in LPS
  std::vector<float> values;                                ///< first axis fastest
};

/// How values between voxels are found when an oblique image is resampled.
enum class Between { linear, nearest };

/// Axes that deviate from LPS by less than this are taken as aligned [degrees].
inline constexpr double aligned_within_degrees = 1.0;

/// The image on an axis-aligned LPS grid: permuted and flipped, or, if an axis deviates from LPS
/// by more than `aligned_within_degrees`, resampled (outside: 0) with a sentence added to `notes`.
/// Throws std::runtime_error if the axes are not orthogonal.
Volume<float> to_lps_grid(GridImage image, Between between, std::vector<std::string>& notes);

}  // namespace mammotwin
