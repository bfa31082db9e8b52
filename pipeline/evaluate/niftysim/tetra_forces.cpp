#include "pipeline/evaluate/niftysim/tetra_forces.h"

#include <Eigen/LU>
#include <cmath>

#include "solver/units.h"

namespace mammotwin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kTouching = 2e-3;  // [mm]; contact there is exact but for single precision

Matrix3d edges(const std::vector<Vector3d>& x, const std::array<int, 4>& c) {
  Matrix3d e;
  for (int i = 0; i < 3; ++i) e.col(i) = x[c[i + 1]] - x[c[0]];
  return e;
}

Matrix3d stress(const Matrix3d& F, double mu, double K) {  // first Piola-Kirchhoff
  const double J = F.determinant();
  const Matrix3d inverse = F.inverse().transpose();
  return mu * std::pow(J, -2.0 / 3) * (F - F.squaredNorm() / 3 * inverse) +
         K * (J - 1) * J * inverse;
}

/// Force along y on one plate's nodes and its first moment along x.
std::pair<double, double> pressed(const NiftySimModel& model, const NiftySimModel::Plate& plate,
                                  const std::vector<Vector3d>& x,
                                  const std::vector<Vector3d>& forces) {
  const double height = plate.corner.y() + plate.displacement.y();
  double force = 0, moment = 0;
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (std::abs(x[n].y() - height) < kTouching)
      force += forces[n].y(), moment += x[n].x() * forces[n].y();
  return {force, moment / force};
}

double moment_of_inertia(const NiftySimModel& model, const std::vector<Vector3d>& x) {
  double mass = 0, second = 0;
  Vector3d first = Vector3d::Zero();
  for (const auto& c : model.tetrahedra) {
    const double m = model.density * std::abs(edges(model.nodes, c).determinant()) / 6;
    const Vector3d middle = (x[c[0]] + x[c[1]] + x[c[2]] + x[c[3]]) / 4;
    mass += m, first += m * middle, second += m * middle.head<2>().squaredNorm();
  }
  return second - first.head<2>().squaredNorm() / mass;
}

}  // namespace

std::vector<Vector3d> nodal_forces(const NiftySimModel& model, const std::vector<Vector3d>& x) {
  std::vector<Vector3d> forces(x.size(), Vector3d::Zero());
  for (const auto& set : model.sets)
    for (const int t : set.elements) {
      const auto& c = model.tetrahedra[t];
      const Matrix3d X = edges(model.nodes, c), inverse = X.inverse();
      const Matrix3d P = stress(edges(x, c) * inverse, set.shear_modulus, set.bulk_modulus);
      const Matrix3d on_corners = -std::abs(X.determinant()) / 6 * P * inverse.transpose();
      for (int i = 0; i < 3; ++i) {
        forces[c[i + 1]] += on_corners.col(i);
        forces[c[0]] -= on_corners.col(i);
      }
    }
  return forces;
}

PlateCouple plate_couple(const NiftySimModel& model, const std::vector<Vector3d>& x) {
  const auto forces = nodal_forces(model, x);
  const auto [up, at_top] = pressed(model, model.plates[0], x, forces);
  const auto [down, at_bottom] = pressed(model, model.plates[1], x, forces);
  PlateCouple couple;
  couple.force_N = (up - down) / 2 * kNewtonPerMilli;
  couple.offset_mm = at_bottom - at_top;
  couple.couple_N_mm = couple.force_N * couple.offset_mm;
  couple.roll_acceleration = couple.couple_N_mm / kNewtonPerMilli / moment_of_inertia(model, x);
  return couple;
}

}  // namespace mammotwin
