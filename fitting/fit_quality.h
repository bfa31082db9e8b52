#pragma once

#include <optional>

#include "fitting/surface/face_mesh.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// Distances [mm] between two surfaces in both directions, weighted by area.
struct SurfaceDistances {
  double rms_mesh_to_data = 0, rms_data_to_mesh = 0;
  double p95 = 0;                                      ///< the larger of both directions
  double max = 0;                                      ///< the larger of both directions
  double max_at_landmark = 0;                          ///< within 15 mm of the landmark
  Eigen::Vector3d farthest = Eigen::Vector3d::Zero();  ///< where max was met [mm, LPS]
};

/// Between the mesh's faces of one label and a triangle surface: from every vertex of each.
SurfaceDistances surface_distances(const HermiteMesh& mesh, const std::vector<FaceLabels>& faces,
                                   FaceLabel label, const TriangleSurface& data,
                                   const Eigen::Vector3d& landmark);

/// Signed distance [mm] to a triangle surface (positive outside of it) on the mesh's skin, 0 on its
/// other faces: something to look at.
PointField skin_distance_field(const MeshFile& file, const TriangleSurface& data);

/// Root mean square distance [mm] of points to the mesh's faces of one label.
double rms_to_faces(const HermiteMesh& mesh, const std::vector<FaceLabels>& faces, FaceLabel label,
                    const std::vector<Eigen::Vector3d>& points);

/// Which voxels' centres lie in the mesh.
struct Coverage {
  double breast = 0;   ///< fraction of the region's breast voxels in front of the wall
  double lesions = 1;  ///< fraction of the lesion voxels, in the region or not
};
Coverage coverage(const HermiteMesh& mesh, const Volume<std::uint8_t>& labels,
                  const BreastRegion& region);

}  // namespace mammotwin
