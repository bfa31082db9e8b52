#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// The most anterior skin point in the region: the middle of the columns that reach within 1 mm
/// of it. Throws std::runtime_error if the region holds no breast voxel.
Eigen::Vector3d most_anterior_point(const Volume<std::uint8_t>& labels, const BreastRegion& region);

/// Centroid and volume of each lesion label, in label order; ids are "lesion-1" and so on.
std::vector<Lesion> measure_lesions(const Volume<std::uint8_t>& labels);

/// First control point of a 3D Slicer markups file, in LPS [mm], whatever frame the file is in.
/// Throws std::runtime_error naming the file.
Eigen::Vector3d read_markups_point(const std::filesystem::path& path);

}  // namespace mammotwin
