#pragma once

#include "fitting/mesh/mesh_file.h"
#include "fitting/surface/triangle_surface.h"

namespace mammotwin {

/// Element faces of one label as triangles, with the material point of every vertex.
struct FaceMesh {
  TriangleSurface surface;
  std::vector<MeshPoint> points;  ///< one a vertex
};

/// Each face as 2 · per_side² triangles; normals point out of the mesh.
FaceMesh face_mesh(const HermiteMesh& mesh, const std::vector<FaceLabels>& faces, FaceLabel label,
                   int per_side);

}  // namespace mammotwin
