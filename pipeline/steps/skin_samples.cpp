#include "pipeline/steps/skin_samples.h"

#include <Eigen/Geometry>

#include "solver/element/face.h"

namespace mammotwin {
namespace {

SkinSample sample_at(const HermiteMesh& mesh, int element, int face, const Eigen::Vector3d& xi,
                     int per_side) {
  const Eigen::Matrix3d J = mesh.jacobian({element, xi});
  const auto [a, b] = face_directions(face);
  Eigen::Vector3d normal = J.col(a).cross(J.col(b));
  if (normal.dot(J.col(face / 2)) * (face % 2 ? 1 : -1) < 0) normal = -normal;
  return {mesh.position({element, xi}), normal.normalized(), normal.norm() / (per_side * per_side)};
}

}  // namespace

std::vector<SkinSample> skin_samples(const MeshFile& mesh, int per_side) {
  std::vector<SkinSample> samples;
  for (int e = 0; e < mesh.mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      for (int k = 0; mesh.faces[e][face] == FaceLabel::skin && k < per_side * per_side; ++k)
        samples.push_back(sample_at(
            mesh.mesh, e, face,
            point_on_face(face, (k % per_side + 0.5) / per_side, (k / per_side + 0.5) / per_side),
            per_side));
  return samples;
}

}  // namespace mammotwin
