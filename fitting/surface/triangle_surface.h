#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace mammotwin {

/// Triangles over shared vertices [mm, LPS].
struct TriangleSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;

  Eigen::Vector3d area_vector(int triangle) const;  ///< normal times area [mm²]

  /// A third of the area of a vertex's triangles [mm²].
  std::vector<double> vertex_areas() const;
};

/// The part with coordinate `axis` ≥ limit (keep_above) or ≤ limit. Triangles are cut at the
/// plane; vertices within `snap` [mm] of it are moved onto it, which spares slivers.
TriangleSurface clip(const TriangleSurface& surface, int axis, double limit, bool keep_above,
                     double snap);

/// The connected part with the largest area, unused vertices dropped.
TriangleSurface largest_part(const TriangleSurface& surface);

/// Vertices minus edges plus triangles: 1 for a disc.
int euler_characteristic(const TriangleSurface& surface);

/// Closed loops of edges that belong to one triangle only, vertex by vertex in order.
std::vector<std::vector<int>> boundary_loops(const TriangleSurface& surface);

}  // namespace mammotwin
