#include "solver/newton/newton.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/LU>

#include "solver/contact/plate_contact.h"
#include "solver/material/neo_hookean.h"
#include "tests/solver/test_meshes.h"

namespace mammotwin {
namespace {

constexpr double kC1 = 3;  // [kPa]

Model gel(const HermiteMesh& mesh, double bulk_ratio = 1e4) {
  return Model(mesh, uniform(std::make_shared<NeoHookean>(kC1)),
               {PressureSpace::trilinear, bulk_ratio, 0});
}

// Displacement patch test: on distorted elements an affine motion of the boundary gives the same
// affine motion inside, with one pressure everywhere. The motion preserves volume, so p only
// balances: any uniform p is in equilibrium with clamped walls; the one found has J = 1 + p/κ, p =
// 0.
TEST(Newton, PatchTestOnDistortedElements) {
  const HermiteMesh mesh = bent(box_mesh({30, 30, 30}, {3, 3, 3}), 8);
  const Model model = gel(mesh);
  Eigen::Matrix3d F;
  F << 1.2, 0.3, 0.0, -0.1, 0.9, 0.2, 0.0, 0.1, 1.0;
  F /= std::cbrt(F.determinant());
  const auto target = affine(mesh, F, {1, 2, 3});
  DofMap dofs(mesh);
  for (int node = 0; node < mesh.num_nodes(); ++node) {
    const int i = node % 4, j = node / 4 % 4, k = node / 16;
    if (i % 3 == 0 || j % 3 == 0 || k % 3 == 0)
      for (int dof = 24 * node; dof < 24 * node + 24; ++dof) dofs.prescribe(dof);
  }
  dofs.number(mesh);
  std::vector<HermiteMesh::Node> pending(mesh.num_nodes(), HermiteMesh::Node::Zero());
  for (int dof = 0; dof < dofs.num_dofs(); ++dof)
    if (dofs.prescribed(dof))
      pending[dof / 24](dof % 24) = target[dof / 24](dof % 24) - mesh.node(dof / 24)(dof % 24);
  State state = model.rest();
  Newton newton(model, dofs);
  const auto report = newton.solve(state, {}, pending);
  ASSERT_TRUE(report.usable()) << report.reason;
  for (int node = 0; node < mesh.num_nodes(); ++node)
    EXPECT_NEAR((state.x[node] - target[node]).norm(), 0, 1e-7);
  EXPECT_LT(report.iterations, 10);
}

/// One eighth of a block between frictionless plates: symmetry planes at x, y, z = 0.
struct Block {
  Eigen::Vector3d size{10, 12, 20};
  HermiteMesh mesh = box_mesh(size, {2, 2, 3});
  Model model = gel(mesh, 1e6);
  DofMap dofs{mesh};
  Block() {
    for (int axis = 0; axis < 3; ++axis) hold_plane(mesh, axis, 0, dofs);
  }
  double force(double stretch) const {  // F = 2 c₁ A₀ (λ − λ⁻²), pressing positive
    return -2 * kC1 * size.x() * size.y() * (stretch - 1 / (stretch * stretch));
  }
};

// A weight that changes its sign whenever it is brought up to the state, as a point does that turns
// from sticking to sliding and back: each step balances what is no longer there.
TEST(Newton, EndsWhereIterationsCircle) {
  constexpr double weight = 0.05;  // [mN/mm^3]
  Block block;
  hold_plane(block.mesh, 2, block.size.z(), block.dofs);
  block.dofs.number(block.mesh);
  double sign = 1;
  NewtonOptions options;
  options.following.refresh = [&](const State&, double) {
    sign = -sign;
    block.model.set_body_force(
        [&](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, sign * weight); });
  };
  State state = block.model.rest();
  Newton newton(block.model, block.dofs);
  const NewtonReport report = newton.solve(state, options);
  EXPECT_FALSE(report.usable());
  EXPECT_NE(report.reason.find("circle"), std::string::npos) << report.reason;
  EXPECT_LT(report.iterations, 60);  // of 120
}

// A load that follows the block's middle and pushes it back by 1.3 times as much as it went: taken
// up to each step it overshoots for ever, held and followed by halves it settles where it balances.
TEST(Newton, FollowsByHalvesWhatOvershoots) {
  constexpr double weight = 0.02;  // [mN/mm^3]
  Block block;
  hold_plane(block.mesh, 2, block.size.z(), block.dofs);
  block.dofs.number(block.mesh);
  const auto middle = [&](const State& state) {
    return HermiteMesh(state.x, block.mesh.elements()).position({6, {1, 1, 0.5}}).z() -
           block.mesh.position({6, {1, 1, 0.5}}).z();
  };
  const auto pull = [&](double load) {
    block.model.set_body_force([=](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, load); });
  };
  Newton newton(block.model, block.dofs);
  State alone = block.model.rest();
  pull(weight);
  ASSERT_TRUE(newton.solve(alone, {}).usable());
  const double gain = 1.3 * weight / middle(alone);
  double back = 0;
  NewtonOptions options;
  options.following.refresh = [&](const State& state, double share) {
    back += share * (gain * middle(state) - back);
    pull(weight - back);
  };
  State state = block.model.rest();
  const NewtonReport report = newton.solve(state, options);
  ASSERT_TRUE(report.usable()) << report.reason;
  EXPECT_NEAR(back, gain * middle(state), 1e-6 * back);
  EXPECT_NEAR(middle(state) / middle(alone), 1 / 2.3, 0.01);
}

// Exact homogeneous state: Newton takes no step from it and few from rest.
TEST(Newton, AxialSqueezeByDisplacementIsTheClosedForm) {
  Block block;
  hold_plane(block.mesh, 2, block.size.z(), block.dofs);
  block.dofs.number(block.mesh);
  const double stretch = 0.7;
  std::vector<HermiteMesh::Node> pending(block.mesh.num_nodes(), HermiteMesh::Node::Zero());
  for (int node = 0; node < block.mesh.num_nodes(); ++node)
    if (block.mesh.node(node)(2, 0) > block.size.z() - 1e-9)
      pending[node](2, 0) = (stretch - 1) * block.size.z();
  State state = block.model.rest();
  Newton newton(block.model, block.dofs);
  const auto report = newton.solve(state, {}, pending);
  ASSERT_TRUE(report.usable()) << report.reason;
  EXPECT_LE(report.iterations, 8);
  double force = 0;
  for (const auto& node : newton.assembler().nodal_residual(state))
    force -= node(2, 0) < 0 ? node(2, 0) : 0;
  // kappa/mu = 1e6 leaves the volume, and so the force, off by about 1e-6.
  EXPECT_NEAR(force / block.force(stretch), 1, 1e-5);
  const auto again = newton.solve(state, {});
  EXPECT_EQ(again.iterations, 0);
}

TEST(Newton, AxialSqueezeByContactIsTheClosedForm) {
  Block block;
  block.dofs.number(block.mesh);
  auto contact = std::make_shared<PlateContact>();
  for (const auto& [e, face] : faces_at(block.mesh, 2, block.size.z()))
    block.model.add_surface_potential(e, face, contact);
  const double stretch = 0.7;
  contact->plates = {Plate{{0, 0, stretch * block.size.z()}, {0, 0, -1}, {0, 1, 0}, 0, true}};
  State state = block.model.rest();
  Newton newton(block.model, block.dofs);
  int iterations = 0;
  for (double penalty : {1.0, 10.0, 100.0, 1000.0, 10000.0}) {
    contact->penalty = penalty;
    const auto report = newton.solve(state, {});
    ASSERT_TRUE(report.usable()) << report.reason << " at " << penalty;
    iterations += report.iterations;
  }
  EXPECT_LE(iterations, 25);
  // The penetration is uniform, so the plate sees the block at stretch λ with force pushing back
  // by ε times the penetration: solve that scalar equation for the top's height instead.
  const double top = state.x.back()(2, 0);
  const double penetration = top - stretch * block.size.z();
  const double force = contact->penalty * penetration * block.size.x() * block.size.y();
  EXPECT_NEAR(force / block.force(top / block.size.z()), 1, 1e-5);
  EXPECT_NEAR(force / block.force(stretch), 1, 3e-4);  // 8 kPa / 1e4 kPa/mm of penetration
  // Contact patch test: the contact pressure is uniform, the top stays flat.
  for (int node = 0; node < block.mesh.num_nodes(); ++node) {
    const bool on_top = block.mesh.node(node)(2, 0) > block.size.z() - 1e-9;
    EXPECT_NEAR(state.x[node](2, 0), on_top ? top : state.x[node](2, 0), 1e-7);
  }
}

// At rest nothing flows: what is left is the least flow, 1e-3 of the softest point's modulus times
// √Σ V^(4/3). Wherever that point stands: the first of its element or another.
TEST(Newton, BalanceAtRestIsJudgedByTheSoftestPoint) {
  const HermiteMesh mesh = box_mesh({10, 10, 20}, {1, 1, 2});
  DofMap dofs(mesh);
  dofs.number(mesh);
  for (const int softest : {0, 100}) {
    const auto material = [&softest, count = 0](const Eigen::Vector3d&, double) mutable {
      return std::make_shared<NeoHookean>(count++ == softest ? 0.5 : kC1);
    };
    const Model model(mesh, material, {});
    const double flow = Assembler(model, dofs).balance(model.rest()).flow;
    EXPECT_NEAR(flow, 1e-3 * 1 * 100 * std::sqrt(2), 1e-12);
  }
}

/// Merits before and after every step of a solve.
struct Descent {
  std::vector<std::pair<double, double>> steps;
  NewtonOptions options;
  Descent() {
    options.watch = [this](double before, double after) { steps.push_back({before, after}); };
  }
  /// To rounding of sums over some 1e4 points.
  void expect_downhill() const {
    EXPECT_GT(steps.size(), 2u);
    for (const auto& [before, after] : steps)
      EXPECT_LE(after - before, 1e-12 * std::max(1.0, std::abs(before)));
  }
};

TEST(Newton, NoStepRaisesTheCondensedEnergyUnderAPlatesEdge) {
  const HermiteMesh mesh = box_mesh({12, 12, 20}, {2, 2, 3});
  Model model(mesh, uniform(std::make_shared<NeoHookean>(kC1)), {});
  DofMap dofs(mesh);
  for (int axis = 0; axis < 3; ++axis) hold_plane(mesh, axis, 0, dofs);
  dofs.number(mesh);
  auto contact = std::make_shared<PlateContact>();
  for (const auto& [e, face] : faces_at(mesh, 2, 20)) model.add_surface_potential(e, face, contact);
  contact->plates = {Plate{{0, 5, 14}, {0, 0, -1}, {0, 1, 0}, 2}};
  State state = model.rest();
  Newton newton(model, dofs);
  Descent descent;
  for (double penalty : {1.0, 30.0, 1000.0}) {
    contact->penalty = penalty;
    const auto report = newton.solve(state, descent.options);
    ASSERT_TRUE(report.usable()) << report.reason << " at " << penalty;
  }
  descent.expect_downhill();
}

TEST(Newton, NoStepRaisesTheCondensedEnergyUnderALoadTooLargeForItsFirstStep) {
  const HermiteMesh mesh = distorted(box_mesh({10, 10, 30}, {2, 2, 3}), 0.4, 11);
  Model model = gel(mesh, 1e6);
  model.set_body_force(uniform_force({0.05, 0, 0.2}));
  DofMap dofs(mesh);
  for (int node = 0; node < 9; ++node)
    for (int dof = 24 * node; dof < 24 * node + 24; ++dof) dofs.prescribe(dof);
  dofs.number(mesh);
  State state = model.rest();
  Descent descent;
  const auto report = Newton(model, dofs).solve(state, descent.options);
  ASSERT_TRUE(report.usable()) << report.reason;
  descent.expect_downhill();
}

TEST(Newton, IsBitwiseTheSameAtAnyNumberOfThreads) {
  std::vector<std::vector<HermiteMesh::Node>> shapes;
  for (int threads : {1, 2, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    HermiteMesh mesh = distorted(box_mesh({30, 30, 30}, {3, 3, 3}), 0.8, 11);
    Model model = gel(mesh);
    model.set_body_force(uniform_force({0, 0, -0.05}));
    DofMap dofs(mesh);
    for (int node = 0; node < 16; ++node)
      for (int dof = 24 * node; dof < 24 * node + 24; ++dof) dofs.prescribe(dof);
    dofs.number(mesh);
    State state = model.rest();
    ASSERT_TRUE(Newton(model, dofs).solve(state, {}).usable());
    shapes.push_back(state.x);
  }
  for (std::size_t node = 0; node < shapes[0].size(); ++node)
    for (int k = 0; k < 24; ++k) {
      EXPECT_EQ(shapes[0][node](k), shapes[1][node](k));
      EXPECT_EQ(shapes[0][node](k), shapes[2][node](k));
    }
}

TEST(Newton, ReportsWhatIsNotInEquilibrium) {
  const HermiteMesh mesh = box_mesh({10, 10, 10}, {1, 1, 1});
  Model model = gel(mesh);
  model.set_body_force(uniform_force({0, 0, -1}));  // nothing holds it
  DofMap dofs(mesh);
  dofs.number(mesh);
  State state = model.rest();
  const auto report = Newton(model, dofs).solve(state, {});
  EXPECT_FALSE(report.usable());
  EXPECT_FALSE(report.reason.empty());
}

}  // namespace
}  // namespace mammotwin
