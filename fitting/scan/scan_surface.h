#pragma once

#include "fitting/surface/triangle_surface.h"

namespace mammotwin {

/// The skin through cleaned points, holes filled.
struct ScanSurface {
  TriangleSurface surface;
  std::vector<int> rim;  ///< vertices of its outer border, in order
  int holes = 0;         ///< that were filled
};

/// Joins points by an advancing front (Cohen-Steiner and Da 2004), keeps the largest part, and
/// fills every hole but the longest border by a fair patch of the same density (Liepa 2003), all by
/// CGAL. Throws std::runtime_error where that is no disc.
ScanSurface scan_surface(const std::vector<Eigen::Vector3d>& points);

}  // namespace mammotwin
