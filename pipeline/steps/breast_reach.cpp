#include "pipeline/steps/breast_reach.h"

#include <algorithm>
#include <limits>

#include "solver/element/face.h"

namespace mammotwin {

BreastReach breast_reach(const MeshFile& mesh, const Eigen::Vector3d& depth) {
  constexpr int n = 8;  // points along each side of a face
  constexpr double nothing = -std::numeric_limits<double>::infinity();
  BreastReach reach{nothing, nothing};
  for (int e = 0; e < mesh.mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      for (int k = 0; mesh.faces[e][face] != FaceLabel::interior && k < n * n; ++k) {
        double& most = mesh.faces[e][face] == FaceLabel::chest_wall ? reach.wall : reach.tip;
        most = std::max(most, depth.dot(mesh.mesh.position(
                                  {e, point_on_face(face, k % n / (n - 1.0), k / n / (n - 1.0))})));
      }
  return reach;
}

}  // namespace mammotwin
