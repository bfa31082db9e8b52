#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/element/skin_membrane.h"
#include "solver/material/neo_hookean.h"
#include "solver/newton/newton.h"
#include "tests/solver/test_meshes.h"
#include "tests/verification/follower_pressure.h"

namespace mammotwin::inflation_test {
namespace {

constexpr double kC1 = 3, kInner = 10, kOuter = 20;  // [kPa], [mm]

/// A quarter of a thick tube of unit length about z: ξ₁ radial, ξ₂ around from x to y.
HermiteMesh tube(int n) {
  return mapped_mesh({n, n, 1}, [](const Eigen::Vector3d& xi) {
    const double r = kInner + (kOuter - kInner) * xi.x(), a = std::numbers::pi / 2 * xi.y();
    return Eigen::Vector3d(r * std::cos(a), r * std::sin(a), 5 * xi.z());
  });
}

// Incompressible neo-Hookean tube in plane strain: r² = R² + c, so with inner radius a and c = a² −
// A² radial balance gives p = ∫ (σθ − σr) dr/r with σθ − σr = 2 c₁ (λ² − λ⁻²), λ = r/R (Ogden,
// Non-linear Elastic Deformations, section 5.3).
double pressure(double inner) {
  double sum = 0;  // Simpson's rule on the integral, so that no closed form is trusted
  constexpr int n = 2000;
  const double c = inner * inner - kInner * kInner;
  for (int k = 0; k <= n; ++k) {
    const double R = kInner + (kOuter - kInner) * k / n, r = std::sqrt(R * R + c);
    const double stretch = r / R;
    const double dr_per_dR = R / r;
    const double f = 2 * kC1 * (stretch * stretch - 1 / (stretch * stretch)) / r * dr_per_dR;
    sum += f * (k == 0 || k == n ? 1 : k % 2 ? 4 : 2);
  }
  return sum * (kOuter - kInner) / n / 3;
}

// The membrane stores c₁ h (λ² + λ⁻² − 2) per reference area in plane strain; the work of p, p r
// dr, is its change, so p = 2 c₁ h / R (1 − λ⁻⁴) at its own radius. Each section carries its part
// of the pressure.
double skin_pressure(double inner, double skin) {
  const double outer = std::sqrt(kOuter * kOuter + inner * inner - kInner * kInner);
  return 2 * skin / kOuter * (1 - std::pow(kOuter / outer, 4));
}

/// skin: c1 h of a membrane round the tube [kPa mm].
double inner_radius_error(int n, double inner, double skin = 0) {
  const HermiteMesh mesh = tube(n);
  Model model(mesh, uniform(std::make_shared<NeoHookean>(kC1)), {PressureSpace::trilinear, 1e6, 0});
  const auto inside = std::make_shared<FollowerPressure>();
  for (int e = 0; e < mesh.num_elements(); ++e)
    if (e % n == 0) model.add_surface_potential(e, 0, inside);
  constexpr double thickness = 1.5;  // [mm] only c1 h counts
  if (skin > 0) {
    const auto membrane = std::make_shared<SkinMembrane>(skin / thickness, thickness);
    for (int e = 0; e < mesh.num_elements(); ++e)
      if (e % n == n - 1) model.add_surface_potential(e, 1, membrane);
  }
  DofMap dofs(mesh);
  hold_plane(mesh, 0, 0, dofs);
  hold_plane(mesh, 1, 0, dofs);
  hold_plane(mesh, 2, 0, dofs);
  hold_plane(mesh, 2, 5, dofs);
  dofs.number(mesh);
  inside->pressure = pressure(inner) + skin_pressure(inner, skin);
  State state = model.rest();
  const auto report = Newton(model, dofs).solve(state, {});
  EXPECT_TRUE(report.usable()) << report.reason;
  return std::abs(state.x[0].col(0).norm() - inner);
}

// A third inflated. Displacement at a node converges at least with the energy's order, 3.
TEST(Inflation, ThickTubeIsTheClosedForm) {
  const double coarse = inner_radius_error(2, 13), fine = inner_radius_error(4, 13);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, 0.002);
  EXPECT_GT(std::log2(coarse / fine), 2.5);
}

// A membrane that carries most of the pressure: 18 of 20.
TEST(Inflation, TubeInAStiffSkinIsTheClosedForm) {
  constexpr double skin = 900;
  EXPECT_GT(skin_pressure(13, skin), 5 * pressure(13));
  const double coarse = inner_radius_error(2, 13, skin), fine = inner_radius_error(4, 13, skin);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, 0.002);
}

}  // namespace
}  // namespace mammotwin::inflation_test
