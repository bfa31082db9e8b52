#pragma once

#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "fitting/surface/triangle_surface.h"

namespace mammotwin {

/// The skin of a mesh as triangles of about 1 mm.
TriangleSurface skin_surface(const MeshFile& file);

/// Root mean square distance of points to a surface [mm].
double rms_distance(const std::vector<Eigen::Vector3d>& points, const TriangleSurface& surface);

/// The larger of both directions [mm], vertices weighed by area.
double rms_distance(const TriangleSurface& a, const TriangleSurface& b);

/// What a camera beside the patient (looking along x) sees of a skin as its outline: the farthest
/// point of the silhouette [mm] on 121 rays from `centre` (y, z), from 60 degrees below the way
/// forward (-y) to 60 degrees above it. 0 where a ray meets nothing.
std::vector<double> side_outline(const TriangleSurface& skin, const Eigen::Vector2d& centre);

}  // namespace mammotwin
