#include "fitting/surface/face_mesh.h"

namespace mammotwin {

namespace {

/// Point (a, b) of a face, such that ∂x/∂a × ∂x/∂b points outwards.
Eigen::Vector3d on_face(int face, double a, double b) {
  const int axis = face / 2;
  const bool upper = face % 2;
  Eigen::Vector3d xi;
  xi[axis] = upper;
  xi[(axis + 1) % 3] = upper ? a : b;
  xi[(axis + 2) % 3] = upper ? b : a;
  return xi;
}

}  // namespace

FaceMesh face_mesh(const HermiteMesh& mesh, const std::vector<FaceLabels>& faces, FaceLabel label,
                   int per_side) {
  FaceMesh result;
  const int n = per_side + 1;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face) {
      if (faces[e][face] != label) continue;
      const int first = static_cast<int>(result.points.size());
      for (int m = 0; m < n * n; ++m) {
        const MeshPoint p{e, on_face(face, static_cast<double>(m % n) / per_side,
                                     static_cast<double>(m / n) / per_side)};
        result.points.push_back(p);
        result.surface.vertices.push_back(mesh.position(p));
      }
      for (int b = 0; b < per_side; ++b)
        for (int a = 0; a < per_side; ++a) {
          const int v = first + a + n * b;
          result.surface.triangles.push_back({v, v + 1, v + n + 1});
          result.surface.triangles.push_back({v, v + n + 1, v + n});
        }
    }
  return result;
}

}  // namespace mammotwin
