#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <vector>

namespace mammotwin {

// 3D Slicer's markups files (.mrk.json), in LPS [mm] whatever frame the file is in. All throw
// std::runtime_error naming the file.

/// The first control point.
Eigen::Vector3d read_markups_point(const std::filesystem::path& path);

/// All control points of all lists and curves; one at least.
std::vector<Eigen::Vector3d> read_markups_points(const std::filesystem::path& path);

/// The first ROI, whose sides must run along the axes to 1 degree.
Eigen::AlignedBox3d read_markups_box(const std::filesystem::path& path);

}  // namespace mammotwin
