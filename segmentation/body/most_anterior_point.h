#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// The most anterior skin point in the region: the middle of the columns that reach within 1 mm
/// of it. Throws std::runtime_error if the region holds no breast voxel.
Eigen::Vector3d most_anterior_point(const Volume<std::uint8_t>& labels, const BreastRegion& region);

}  // namespace mammotwin
