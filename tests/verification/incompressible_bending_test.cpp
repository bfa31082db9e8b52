#include <gtest/gtest.h>

#include <cmath>

#include "solver/material/neo_hookean.h"
#include "solver/newton/newton.h"
#include "tests/solver/test_meshes.h"
#include "tests/verification/dead_traction.h"

namespace mammotwin::incompressible_bending_test {
namespace {

// Cook's membrane in plane strain, incompressible: 48 long, 44 high at the clamped side, 16 at the
// loaded one, shear force 100 per unit thickness, μ = 80.1938 (J. C. Simo, F. Armero, Int. J.
// Numer. Meth. Eng. 33, 1992, section 6.2, where refined meshes reach a vertical way of the upper
// corner of about 6.9).
double cook_corner(int n) {
  constexpr double mu = 80.1938, force = 100, right = 16;
  const HermiteMesh mesh = mapped_mesh({n, n, 1}, [](const Eigen::Vector3d& xi) {
    return Eigen::Vector3d(48 * xi.x(), 44 * xi.x() + xi.y() * (44 - 28 * xi.x()), xi.z());
  });
  Model model(mesh, uniform(std::make_shared<NeoHookean>(mu / 2)),
              {PressureSpace::trilinear, 1e6, 0});
  const auto shear = std::make_shared<DeadTraction>(
      [&](const SurfacePoint&) { return Eigen::Vector3d(0, force / right, 0); });
  DofMap dofs(mesh);
  for (int e = 0; e < mesh.num_elements(); ++e) {
    if (e % n == n - 1) model.add_surface_potential(e, 1, shear);
    if (e % n == 0)
      for (int i = 0; i < 3; ++i)
        for (int dof : face_dofs(mesh, e, 0, i)) dofs.prescribe(dof);
    for (const int face : {4, 5})
      for (int dof : face_dofs(mesh, e, face, 2)) dofs.prescribe(dof);
  }
  dofs.number(mesh);
  State state = model.rest();
  const NewtonReport report = Newton(model, dofs).solve(state, {});
  EXPECT_TRUE(report.usable()) << report.reason;
  const int corner = (n + 1) * (n + 1) - 1;
  return state.x[corner](1, 0) - mesh.node(corner)(1, 0);
}

TEST(CooksMembrane, DoesNotLock) {
  const double coarse = cook_corner(2), middle = cook_corner(4), fine = cook_corner(12);
  RecordProperty("coarse_middle_fine_mm", std::to_string(coarse) + " " + std::to_string(middle) +
                                              " " + std::to_string(fine));
  EXPECT_NEAR(fine, 6.9, 0.05);
  EXPECT_NEAR(middle / fine, 1, 0.002);
  EXPECT_NEAR(coarse / fine, 1, 0.005);
}

/// Half a strip of width 2a and height 2h in plane strain, bonded to rigid plates that come nearer
/// by 0.1 %; a quarter of its section, x from the middle to the rim, y from the middle to the
/// plate.
struct BondedStrip {
  static constexpr double kMu = 6, kHalfHeight = 1, kStrain = 1e-3;
  double half_width;
  Eigen::Vector3i n;
  HermiteMesh mesh;
  Model model;
  State state;

  BondedStrip(double aspect, const Eigen::Vector3i& elements)
      : half_width(2 * kHalfHeight * aspect),
        n(elements),
        mesh(box_mesh({half_width, kHalfHeight, 1}, n)),
        model(mesh, uniform(std::make_shared<NeoHookean>(kMu / 2)),
              {PressureSpace::trilinear, 1e6, 0}),
        state(model.rest()) {
    DofMap dofs(mesh);
    hold_plane(mesh, 0, 0, dofs);
    hold_plane(mesh, 1, 0, dofs);
    hold_plane(mesh, 2, 0, dofs);
    hold_plane(mesh, 2, 1, dofs);
    std::vector<HermiteMesh::Node> pending(mesh.num_nodes(), HermiteMesh::Node::Zero());
    for (const auto& [e, face] : faces_at(mesh, 1, kHalfHeight))
      for (int i = 0; i < 3; ++i)
        for (int dof : face_dofs(mesh, e, face, i)) dofs.prescribe(dof);
    for (int i = 0; i < mesh.num_nodes(); ++i)
      if (std::abs(mesh.node(i)(1, 0) - kHalfHeight) < 1e-9)
        pending[i](1, 0) = -kStrain * kHalfHeight;
    dofs.number(mesh);
    const NewtonReport report = Newton(model, dofs).solve(state, {}, pending);
    EXPECT_TRUE(report.usable()) << report.reason;
  }

  /// Force of the plate over width and strain [kPa], by the work of the last bit of strain: energy
  /// is quadratic in it.
  double apparent_modulus() const {
    double energy = 0;
    ElementSystem system;
    for (int e = 0; e < model.num_elements(); ++e) {
      model.evaluate(e, state, TangentKind::none, system);
      energy += system.energy;
    }
    return 2 * energy / (half_width * kHalfHeight * kStrain * kStrain);
  }
};

// A thin incompressible strip squeezes its tissue out as a viscous film does: with full height H =
// 2h, p(x) = 6 μ δ/H³ (a² − x²) and the apparent modulus is 4 μ S², S = a/H (lubrication; p'' = −12
// μ δ/H³). Plane-strain compression adds 4 μ in Gent's sum (A. N. Gent, P. B. Lindley, Proc. Inst.
// Mech. Eng. 173, 1959), 1 % at S = 10; the rim takes off some.
TEST(BondedStrip, IsAsStiffAsLubricationSaysAndNotLocked) {
  const BondedStrip one(10, {10, 1, 1}), fine(10, {20, 3, 1});
  const double gent = 4 * BondedStrip::kMu * (1 + 10 * 10);
  RecordProperty("over_gent", std::to_string(one.apparent_modulus() / gent) + " " +
                                  std::to_string(fine.apparent_modulus() / gent));
  EXPECT_NEAR(fine.apparent_modulus() / gent, 1, 0.02);
  EXPECT_NEAR(one.apparent_modulus() / fine.apparent_modulus(), 1, 0.001);
}

TEST(BondedStrip, HasAPressureWithoutOscillation) {
  for (const Eigen::Vector3i& n : {Eigen::Vector3i(10, 1, 1), {10, 2, 1}, {20, 3, 1}}) {
    const BondedStrip strip(10, n);
    const double a = strip.half_width, H = 2 * BondedStrip::kHalfHeight;
    const double peak = 6 * BondedStrip::kMu * BondedStrip::kStrain * a * a / (H * H);
    double worst = 0;
    for (int e = 0; e < strip.model.num_elements(); ++e) {
      const SolidElement& element = strip.model.element(e);
      const auto p = element.pressures(strip.model.coefficients(strip.state.x, e),
                                       &strip.state.pressure[8 * e]);
      for (int q = 0; q < kPoints; ++q) {
        const double x = element.point_position(q).x();
        if (x > a - 2 * H) continue;  // the rim's own field
        const double film = 6 * BondedStrip::kMu * BondedStrip::kStrain * (a * a - x * x) / (H * H);
        worst = std::max(worst, std::abs(-p[q] - film));
      }
    }
    RecordProperty("worst_over_peak_" + std::to_string(n.x()) + "x" + std::to_string(n.y()),
                   std::to_string(worst / peak));
    EXPECT_LT(worst, 0.015 * peak) << n.transpose();
  }
}

}  // namespace
}  // namespace mammotwin::incompressible_bending_test
