#include "solver/element/dead_forces.h"

#include "solver/element/element_coefficients.h"
#include "solver/element/face.h"

namespace mammotwin {
namespace {

/// The work that a pressure of the reference shape does, its direction kept.
class DeadPressure : public SurfacePotential {
 public:
  explicit DeadPressure(const SkinPressure& pressure) : pressure_(pressure) {}
  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int,
               SurfaceResponse& response) const override {
    const Eigen::Vector3d inward_force = -pressure_(point.X, point.normal) * point.normal;
    response.energy = -inward_force.dot(y.head<3>());
    response.gradient.setZero();
    response.gradient.head<3>() = -inward_force;
    response.hessian.setZero();
    return !inward_force.isZero();
  }

 private:
  const SkinPressure& pressure_;
};

}  // namespace

DeadForces forces_of_pressure(const MeshFile& shape, const SkinPressure& pressure) {
  constexpr int points1d = 8;  // a plate ends within faces
  const DeadPressure load(pressure);
  const HermiteMesh& mesh = shape.mesh;
  DeadForces forces(mesh.num_elements(), SolidElement::Coefficients::Zero());
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face) {
      if (shape.faces[e][face] != FaceLabel::skin) continue;
      const SolidElement::Coefficients x = element_coefficients(mesh, mesh.nodes(), e);
      ElementSystem system;
      system.residual.setZero();
      Face(e, face, x, points1d).add(load, x, TangentKind::none, system);
      forces[e] -= system.residual.reshaped(kFunctions, 3);
    }
  return forces;
}

DeadForces scaled(DeadForces forces, double factor) {
  for (SolidElement::Coefficients& f : forces) f *= factor;
  return forces;
}

}  // namespace mammotwin
