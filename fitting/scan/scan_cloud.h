#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace mammotwin {

/// Points of a scanned skin, cleaned [mm].
struct ScanCloud {
  std::vector<Eigen::Vector3d> points;  ///< smoothed over their neighbours, about 1.5 mm apart
  double noise_mm = 0;                  ///< standard deviation of the raw points, off the surface
  int outliers = 0;                     ///< that were taken out
};

/// Reads the points of a PLY, STL, OBJ, OFF or XYZ file (normals may stand beside them and are not
/// needed), each coordinate times `unit_mm` [mm].
///
/// Throws std::runtime_error naming the file and the likely cause where it cannot be read, has
/// coordinates that are not numbers, fewer than 1,000 distinct points, all points in a plane, or an
/// extent that is no breast's (60 to 800 mm): then the unit is likely another.
std::vector<Eigen::Vector3d> read_scan_points(const std::filesystem::path& path, double unit_mm);

/// Takes out points whose 8 neighbours are farther than 3 average spacings away, then smooths
/// (jets of degree 2 over 24 neighbours; Cazals and Pouget 2005) and thins them.
ScanCloud clean_scan(const std::vector<Eigen::Vector3d>& points);

}  // namespace mammotwin
