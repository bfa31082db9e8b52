#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

namespace mammotwin {

// Reading 3D Slicer's markups files (.mrk.json), in LPS [mm] whichever of LPS and RAS the file
// uses. All throw std::runtime_error naming the file and what is missing or wrong.

/// A control point.
struct MarkupPoint {
  std::string label;
  Eigen::Vector3d x_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
  std::string description = {};
};

/// All control points of all lists and curves that have a place; one at least.
std::vector<MarkupPoint> read_markups(const std::filesystem::path& path);

/// The place of the first of them.
Eigen::Vector3d read_markups_point(const std::filesystem::path& path);

/// The places of all.
std::vector<Eigen::Vector3d> read_markups_points(const std::filesystem::path& path);

/// The first ROI, whose sides must run along the axes to 1 degree.
Eigen::AlignedBox3d read_markups_box(const std::filesystem::path& path);

}  // namespace mammotwin
