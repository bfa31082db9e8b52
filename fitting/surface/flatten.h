#pragma once

#include <string>

#include "fitting/surface/triangle_surface.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// A disc of skin laid on the unit square: u runs with x, v with z, each edge of the surface in
/// its cut plane goes to the square's side by arc length, the inside harmonically (by
/// cotangents: Eck et al. 1995), which hardly depends on how the surface is cut into triangles.
/// Angles beyond 90 degrees could flip a triangle; of the skins of 042 and five label maps none is.
struct FlatSkin {
  std::vector<Eigen::Vector2d> uv;  ///< one a vertex
  /// Vertices of the four edges from corner to corner: u = 0, u = 1, v = 0, v = 1, in the
  /// sense of the coordinate that varies.
  std::array<std::vector<int>, 4> edges;
};

/// Why the surface cannot be laid on a square; empty if it can: it must be a disc whose boundary
/// passes each of the region's four corners once.
std::string why_not_a_square(const TriangleSurface& skin, const BreastRegion& region);

/// Throws std::runtime_error with why_not_a_square, or if the flattening fails.
FlatSkin flatten(const TriangleSurface& skin, const BreastRegion& region);

}  // namespace mammotwin
