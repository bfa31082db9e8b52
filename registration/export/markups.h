#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace mammotwin {

/// A control point of a 3D Slicer markups file.
struct MarkupPoint {
  std::string label;
  Eigen::Vector3d x_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
  std::string description = {};
};

/// Writes one fiducial list in LPS (`.mrk.json`, markups schema 1.0.3).
void write_markups(const std::filesystem::path& path, const std::vector<MarkupPoint>& points);

/// A line through points [mm] that ends where it began, in the same file format (type ClosedCurve).
void write_closed_curve(const std::filesystem::path& path, const std::string& name,
                        const std::vector<Eigen::Vector3d>& in_lps);

/// All control points of a `.mrk.json`, in LPS whichever of LPS and RAS the file uses.
/// Throws std::runtime_error naming the file and the field that is missing or wrong.
std::vector<MarkupPoint> read_markups(const std::filesystem::path& path);

}  // namespace mammotwin
