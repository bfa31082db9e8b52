#include <gtest/gtest.h>

#include <cmath>

#include "solver/material/neo_hookean.h"
#include "solver/newton/newton.h"
#include "tests/solver/test_meshes.h"
#include "tests/verification/dead_traction.h"

namespace mammotwin::exact_states_test {
namespace {

constexpr double kC1 = 2, kSide = 20;  // [kPa], [mm]
constexpr double kWeight = 0.2;        // [mN/mm³], 20 times that of tissue

// A slab of thickness L bonded to a wall x = 0 sags along z under its weight f, far from its ends:
// simple shear with P_zx = μ γ, so γ = f (L − X)/μ and u_z = f (L X − X²/2)/μ, μ = 2 c1, at any
// strain (neo-Hookean shear stress is linear). p = 0 with a law that is stress-free at rest; on
// planes z = constant the slab's other parts pull with P_xz = 2 c1 γ. The displacement is
// quadratic: in the space of the elements, which must find it exactly.
struct SaggingSlab {
  HermiteMesh mesh;
  Model model;
  DofMap dofs;

  static double shear(double X) { return kWeight * (kSide - X) / (2 * kC1); }
  static double sag(double X) { return kWeight * (kSide * X - X * X / 2) / (2 * kC1); }

  explicit SaggingSlab(int n)
      : mesh(box_mesh({kSide, kSide, kSide}, {n, n, n})),
        model(mesh, uniform(std::make_shared<NeoHookean>(kC1)), {PressureSpace::trilinear, 1e6, 0}),
        dofs(mesh) {
    model.set_body_force(uniform_force({0, 0, kWeight}));
    const auto pull = std::make_shared<DeadTraction>([](const SurfacePoint& point) {
      return Eigen::Vector3d(2 * kC1 * shear(point.X.x()) * point.normal.z(), 0, 0);
    });
    for (const double z : {0.0, kSide})
      for (const auto& [e, face] : faces_at(mesh, 2, z)) model.add_surface_potential(e, face, pull);
    for (int axis = 0; axis < 3; ++axis)
      for (const auto& [e, face] : faces_at(mesh, 0, 0))
        for (int dof : face_dofs(mesh, e, face, axis)) dofs.prescribe(dof);
    for (const double y : {0.0, kSide}) hold_plane(mesh, 1, y, dofs);
    dofs.number(mesh);
  }

  State exact() const {
    State state = model.rest();
    const double h = mesh.node(0)(0, 1);  // element length along x
    for (int i = 0; i < mesh.num_nodes(); ++i) {
      const double X = mesh.node(i)(0, 0);
      state.x[i](2, 0) += sag(X);
      state.x[i](2, 1) += h * shear(X);
    }
    return state;
  }
};

TEST(ExactState, OfASaggingSlabIsKeptWithoutAnIteration) {
  SaggingSlab slab(2);
  State state = slab.exact();
  Newton newton(slab.model, slab.dofs);
  const NewtonReport report = newton.solve(state, {});
  EXPECT_TRUE(report.usable()) << report.reason;
  EXPECT_EQ(report.iterations, 0);
}

TEST(ExactState, OfASaggingSlabIsFoundFromRest) {
  for (const int n : {1, 3}) {
    SaggingSlab slab(n);
    State state = slab.model.rest();
    const NewtonReport report = Newton(slab.model, slab.dofs).solve(state, {});
    ASSERT_TRUE(report.usable()) << report.reason;
    const State exact = slab.exact();
    for (int i = 0; i < slab.mesh.num_nodes(); ++i)  // 1e-7 of the flow is left
      EXPECT_NEAR((state.x[i].col(0) - exact.x[i].col(0)).norm(), 0, 1e-5);
  }
}

/// A bent block held at one end and pulled into the homogeneous F = diag(λ, λ^-½, λ^-½) by the
/// tractions that belong to it.
struct StretchedBlock {
  static constexpr double kStretch = 1.7;
  Eigen::Matrix3d F =
      Eigen::Vector3d(kStretch, 1 / std::sqrt(kStretch), 1 / std::sqrt(kStretch)).asDiagonal();
  HermiteMesh mesh = bent(box_mesh({kSide, kSide, kSide}, {2, 2, 2}), 2);
  Model model{mesh, uniform(std::make_shared<NeoHookean>(kC1)), {PressureSpace::trilinear, 1e6, 0}};
  DofMap dofs{mesh};

  StretchedBlock() {
    const Eigen::Matrix3d P = NeoHookean(kC1).stress(F);
    const auto traction = std::make_shared<DeadTraction>(
        [P](const SurfacePoint& point) { return (P * point.normal).eval(); });
    for (int e = 0; e < mesh.num_elements(); ++e)
      for (int face = 0; face < 6; ++face) {
        const int cell[3] = {e % 2, e / 2 % 2, e / 4};
        if (cell[face / 2] != face % 2) continue;  // not outside
        if (face > 0) {
          model.add_surface_potential(e, face, traction);
          continue;
        }
        for (int i = 0; i < 3; ++i)
          for (int dof : face_dofs(mesh, e, face, i)) dofs.prescribe(dof);
      }
    dofs.number(mesh);
  }
  State exact() const { return {affine(mesh, F, Eigen::Vector3d::Zero()), model.rest().pressure}; }
};

TEST(ExactState, OfAStretchedBlockIsKeptWithoutAnIteration) {
  const StretchedBlock block;
  State state = block.exact();
  NewtonOptions options;
  options.keep_unstable = true;  // pulled at its sides, too, with dead loads, it is no minimum
  const NewtonReport report = Newton(block.model, block.dofs).solve(state, options);
  EXPECT_TRUE(report.usable()) << report.reason;
  EXPECT_EQ(report.iterations, 0);
}

/// A bar pulled to a stretch of 1.7 along x from rest; residual after k iterations [mN].
double residual_after(int k) {
  constexpr double stretch = 1.7;
  const HermiteMesh mesh = box_mesh({kSide, kSide, kSide}, {2, 2, 2});
  Model model(mesh, uniform(std::make_shared<NeoHookean>(kC1)), {PressureSpace::trilinear, 1e6, 0});
  const auto pull = std::make_shared<DeadTraction>([](const SurfacePoint&) {
    return Eigen::Vector3d(2 * kC1 * (stretch - 1 / (stretch * stretch)), 0, 0);
  });
  for (const auto& [e, face] : faces_at(mesh, 0, kSide)) model.add_surface_potential(e, face, pull);
  DofMap dofs(mesh);
  for (int axis = 0; axis < 3; ++axis) hold_plane(mesh, axis, 0, dofs);
  dofs.number(mesh);
  NewtonOptions options;
  options.max_iterations = k;
  options.tolerance = options.constraint_tolerance = 0;
  Newton newton(model, dofs);
  State state = model.rest();
  newton.solve(state, options);
  return newton.balance(state).residual.norm();
}

// Newton's method squares the error: log r₃/r₂ over log r₂/r₁ is 2 once the error is small.
TEST(ExactState, IsApproachedQuadratically) {
  std::vector<double> residuals;
  for (int k = 0; k <= 12; ++k) {
    residuals.push_back(residual_after(k));
    if (residuals.back() < 1e-6) break;  // one more and rounding rules
  }
  const std::size_t n = residuals.size();
  ASSERT_GE(n, 4u);
  for (std::size_t k = 0; k < n; ++k)
    RecordProperty("residual_" + std::to_string(k), std::to_string(1e9 * residuals[k]) + "e-9");
  const double order =
      std::log(residuals[n - 1] / residuals[n - 2]) / std::log(residuals[n - 2] / residuals[n - 3]);
  EXPECT_GT(order, 1.8);
}

}  // namespace
}  // namespace mammotwin::exact_states_test
