#pragma once

#include <Eigen/Core>
#include <filesystem>

namespace mammotwin {

/// First control point of a 3D Slicer markups file, in LPS [mm], whatever frame the file is in.
/// Throws std::runtime_error naming the file.
Eigen::Vector3d read_markups_point(const std::filesystem::path& path);

}  // namespace mammotwin
