#pragma once

#include <filesystem>
#include <vector>

#include "fitting/surface/triangle_surface.h"

namespace mammotwin {

/// A mannequin-like breast of one material and its laser scan. The skin is a formula [mm, LPS]:
///
///   x = s,   y = s²/800 − h,   z = t − h/4,   −85 ≤ s, t ≤ 85,
///   h = 62 exp(−(ρ/50)³) + 5 exp(−(s² + (t + 4)²) / (2·4²)),   ρ² = s² + t²:
///
/// a dome of 62 mm that hangs by a quarter of its height, with a nipple of 5 mm, on a curved chest.
Eigen::Vector3d gel_breast_skin(double s, double t);

/// The skin as triangles of about `step` mm; normals leave the breast.
TriangleSurface gel_breast_surface(double step_mm);

/// Where the scan has holes: middles on the skin, all of one radius.
struct ScanHoles {
  std::vector<Eigen::Vector3d> middles;
  double radius_mm = 13;
};
ScanHoles gel_breast_holes();

/// About 19,000 points, evenly over the skin but for three holes, each moved by a Gaussian of
/// 0.3 mm in x, y and z, and one in a hundred anywhere in the box of the breast.
std::vector<Eigen::Vector3d> gel_breast_scan(int seed);

/// Binary PLY, single precision. Throws std::runtime_error if it cannot be written.
void write_point_ply(const std::filesystem::path& path, const std::vector<Eigen::Vector3d>& points);

}  // namespace mammotwin
