#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "segmentation/files/markups.h"

namespace mammotwin {

/// Writes one fiducial list in LPS (`.mrk.json`, markups schema 1.0.3).
void write_markups(const std::filesystem::path& path, const std::vector<MarkupPoint>& points);

/// A line through points [mm] that ends where it began, in the same file format (type ClosedCurve).
void write_closed_curve(const std::filesystem::path& path, const std::string& name,
                        const std::vector<Eigen::Vector3d>& in_lps);

}  // namespace mammotwin
