#include <gtest/gtest.h>

#include <cmath>

#include "solver/material/neo_hookean.h"
#include "solver/newton/newton.h"
#include "tests/solver/test_meshes.h"

namespace mammotwin::gravity_test {
namespace {

constexpr double kC1 = 1, kHeight = 40;  // [kPa], [mm]
constexpr double kWeight = 1e-6 * 9810;  // density times gravity [mN/mm³]

/// A column that hangs from z = 0, its sides free, in a quarter of its section.
struct Column {
  HermiteMesh mesh = box_mesh({5, 5, kHeight}, {1, 1, 6});
  Model model{mesh, uniform(std::make_shared<NeoHookean>(kC1)), {PressureSpace::trilinear, 1e6, 0}};
  DofMap dofs{mesh};
  Column() {
    for (int axis = 0; axis < 3; ++axis) hold_plane(mesh, axis, 0, dofs);
    dofs.number(mesh);
  }
};

/// Stretch whose first Piola-Kirchhoff stress 2 c₁ (λ − λ⁻²) is P, by Newton.
double stretch_at(double P) {
  double stretch = 1;
  for (int k = 0; k < 50; ++k)
    stretch -= (2 * kC1 * (stretch - 1 / (stretch * stretch)) - P) /
               (2 * kC1 * (1 + 2 / (stretch * stretch * stretch)));
  return stretch;
}

// One-dimensional theory for a slender column that may narrow at its root: the section at X carries
// the weight of what hangs below, P = ρ g (L − X); length = ∫ λ dX. Narrowing along 40 mm bends
// lines by (d/L)² of the strain: 1 % of the 2 mm elongation.
TEST(Gravity, HangingColumnStretchesAsItShould) {
  Column column;
  column.model.set_body_force(
      uniform_force({0, 0, 20 * kWeight}));  // 20 g, so that strains are finite
  State state = column.model.rest();
  const auto report = Newton(column.model, column.dofs).solve(state, {});
  ASSERT_TRUE(report.usable()) << report.reason;
  double length = 0;
  constexpr int points = 400;
  for (int k = 0; k < points; ++k)
    length += stretch_at(20 * kWeight * kHeight * (1 - (k + 0.5) / points)) * kHeight / points;
  const double elongation = length - kHeight;
  EXPECT_GT(elongation, 2);
  EXPECT_NEAR(state.x.back()(2, 0) - kHeight, elongation, 0.01 * elongation);
}

TEST(Gravity, OnThenOffReturnsTheUnloadedShape) {
  Column column;
  Newton newton(column.model, column.dofs);
  State state = column.model.rest();
  column.model.set_body_force(uniform_force({0, 0, 20 * kWeight}));
  ASSERT_TRUE(newton.solve(state, {}).usable());
  column.model.set_body_force(uniform_force({0, 0, 0}));
  ASSERT_TRUE(newton.solve(state, {}).usable());
  for (int i = 0; i < column.mesh.num_nodes(); ++i)  // to the residual's tolerance
    EXPECT_NEAR((state.x[i] - column.mesh.node(i)).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace mammotwin::gravity_test
