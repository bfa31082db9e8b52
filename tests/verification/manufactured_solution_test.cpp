#include <gtest/gtest.h>

#include <cmath>

#include "solver/material/kinematics.h"
#include "solver/material/neo_hookean.h"
#include "solver/newton/newton.h"
#include "tests/solver/test_meshes.h"
#include "tests/verification/dead_traction.h"

namespace mammotwin::manufactured_solution_test {
namespace {

constexpr double kSide = 20, kC1 = 1, kShear = 4, kPressure = 0.8;  // [mm], [kPa], [mm], [kPa]

/// Two shears, one after the other: J = 1 everywhere. The pressure is in no pressure space.
///     x = X + s sin(Y/L), y = Y + s sin(Z/L), z = Z;   p = p₀ sin(2X/L) cos(Z/L)
constexpr double kLength = 10;

Eigen::Vector3d motion(const Eigen::Vector3d& X) {
  return {X.x() + kShear * std::sin(X.y() / kLength), X.y() + kShear * std::sin(X.z() / kLength),
          X.z()};
}

Eigen::Matrix3d gradient(const Eigen::Vector3d& X) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 1) = kShear / kLength * std::cos(X.y() / kLength);
  F(1, 2) = kShear / kLength * std::cos(X.z() / kLength);
  return F;
}

double pressure(const Eigen::Vector3d& X) {
  return kPressure * std::sin(2 * X.x() / kLength) * std::cos(X.z() / kLength);
}

Eigen::Matrix3d stress(const Eigen::Vector3d& X) {
  const Eigen::Matrix3d F = gradient(X);
  return NeoHookean(kC1).stress(F) + pressure(X) * cofactor(F);
}

/// −Div P by central differences: h² + ε/h ~ 1e-9, far below the errors measured.
Eigen::Vector3d body_force(const Eigen::Vector3d& X) {
  constexpr double h = 1e-3;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int j = 0; j < 3; ++j) {
    const Eigen::Vector3d dX = h * Eigen::Vector3d::Unit(j);
    sum -= (stress(X + dX).col(j) - stress(X - dX).col(j)) / (2 * h);
  }
  return sum;
}

struct Errors {
  double displacement = 0, gradient = 0, pressure = 0;  ///< root mean squares
};

HermiteMesh mesh_of(int n, bool bend) {
  const HermiteMesh box = box_mesh({kSide, kSide, kSide}, {n, n, n});
  return bend ? bent(box, 3) : box;
}

Errors errors(int n, bool bend) {
  const HermiteMesh mesh = mesh_of(n, bend);
  Model model(mesh, uniform(std::make_shared<NeoHookean>(kC1)), {PressureSpace::trilinear, 1e6, 0});
  model.set_body_force(body_force);
  const auto traction = std::make_shared<DeadTraction>(
      [](const SurfacePoint& point) { return (stress(point.X) * point.normal).eval(); });
  // The exact motion's nodal parameters: composed with the mesh's own map by the chain rule, which
  // mapped_mesh does by differences; a box's are prescribed on all faces but the top.
  const HermiteMesh exact = mapped_mesh({n, n, n}, [&](const Eigen::Vector3d& xi) {
    const Eigen::Vector3d s = (n * xi).cwiseMin(n - 1e-12);
    const Eigen::Vector3i cell = s.array().floor().cast<int>().cwiseMax(0).cwiseMin(n - 1);
    const int e = cell.x() + n * (cell.y() + n * cell.z());
    return motion(mesh.position({e, n * xi - cell.cast<double>()}));
  });
  DofMap dofs(mesh);
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face) {
      const int cell[3] = {e % n, e / n % n, e / n / n};
      if (cell[face / 2] != (face % 2) * (n - 1)) continue;
      if (face == 5) {
        model.add_surface_potential(e, face, traction, 8);
        continue;
      }
      for (int i = 0; i < 3; ++i)
        for (int dof : face_dofs(mesh, e, face, i)) dofs.prescribe(dof);
    }
  dofs.number(mesh);
  std::vector<HermiteMesh::Node> pending(mesh.num_nodes(), HermiteMesh::Node::Zero());
  for (int dof = 0; dof < dofs.num_dofs(); ++dof)
    if (dofs.prescribed(dof))
      pending[dof / 24](dof % 24) = exact.node(dof / 24)(dof % 24) - mesh.node(dof / 24)(dof % 24);
  State state = model.rest();
  const auto report = Newton(model, dofs).solve(state, {}, pending);
  EXPECT_TRUE(report.usable()) << report.reason;

  Errors sum;
  const HermiteMesh solved(state.x, mesh.elements());
  const auto& t = hermite_table().points;
  double volume = 0;
  for (int e = 0; e < mesh.num_elements(); ++e) {
    const auto x = model.coefficients(state.x, e);
    const auto F = model.element(e).deformation_gradients(x);
    const auto p = model.element(e).pressures(x, state.pressure.data() + 8 * e);
    for (int q = 0; q < kPoints; ++q) {
      const Eigen::Vector3d X = model.element(e).point_position(q);
      const double w = model.element(e).point_weight(q);
      const Eigen::Vector3d here = solved.position({e, {t[q & 3], t[q >> 2 & 3], t[q >> 4]}});
      sum.displacement += w * (here - motion(X)).squaredNorm();
      sum.gradient += w * (F[q] - gradient(X)).squaredNorm();
      sum.pressure += w * std::pow(p[q] - pressure(X), 2);
      volume += w;
    }
  }
  return {std::sqrt(sum.displacement / volume), std::sqrt(sum.gradient / volume),
          std::sqrt(sum.pressure / volume)};
}

void expect_orders(bool bend) {
  const Errors coarse = errors(2, bend), fine = errors(4, bend);
  // Trilinear pressure without continuity is what limits a cubic displacement: order 3 in L2 and 2
  // in H1 for displacement; its own order lies between 1 and 2 (design, section 3: about first).
  EXPECT_GT(std::log2(coarse.displacement / fine.displacement), 2.8);
  EXPECT_GT(std::log2(coarse.gradient / fine.gradient), 1.9);
  EXPECT_GT(std::log2(coarse.pressure / fine.pressure), 1.3);
}

TEST(ManufacturedSolution, OrdersOnUniformMeshes) { expect_orders(false); }
TEST(ManufacturedSolution, OrdersOnBentMeshes) { expect_orders(true); }

}  // namespace
}  // namespace mammotwin::manufactured_solution_test
