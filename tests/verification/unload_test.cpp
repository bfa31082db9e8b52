#include <gtest/gtest.h>

#include "solver/gravity/fit_stiffness.h"
#include "solver/material/neo_hookean.h"
#include "tests/solver/dome_breast.h"

namespace mammotwin::unload_test {
namespace {

constexpr double kC1 = 1, kLength = 40;  // [kPa], [mm]
constexpr double kWeight = 1e-6 * 9810;  // density times gravity [mN/mm³]

/// A body that hangs along +z from a wall at z = 0 on which it slides against faint springs; sides
/// free.
BreastProblem hanging_body(const HermiteMesh& mesh, const TissueSampler& tissue, double pull) {
  BreastProblem problem;
  FaceLabels inside;
  inside.fill(FaceLabel::interior);
  problem.mesh.mesh = mesh;
  problem.mesh.faces.assign(mesh.num_elements(), inside);
  for (const auto& [e, face] : faces_at(mesh, 2, 0))
    problem.mesh.faces[e][face] = FaceLabel::chest_wall;
  problem.tissue = tissue;
  problem.laws.laws = {std::make_shared<NeoHookean>(kC1), std::make_shared<NeoHookean>(5 * kC1),
                       std::make_shared<NeoHookean>(kC1)};
  problem.boundary.chest_wall_spring = 1e-5;
  problem.gravity = {0, 0, 9810 * pull};
  return problem;
}

UnloadOptions without_checks() {
  UnloadOptions options;
  options.check = false;
  return options;
}

/// Stretch whose Cauchy stress 2 c₁ (λ² − 1/λ) is sigma, by Newton.
double stretch_at(double sigma) {
  double stretch = 1;
  for (int k = 0; k < 50; ++k)
    stretch -= (2 * kC1 * (stretch * stretch - 1 / stretch) - sigma) /
               (2 * kC1 * (2 * stretch + 1 / (stretch * stretch)));
  return stretch;
}

// The hanging column is known: its section is the same everywhere, so the section at z carries
// sigma = ρ g (l − z), and a slice dz was dz/λ long. One-dimensional theory errs by (d/L)² of the
// strain, and the wall's penalty gives way by 1e-3 of the rest.
TEST(Unload, ColumnThatHangsStraightWasThisLong) {
  constexpr double pull = 20;
  const auto fat = [](const Eigen::Vector3d&, double) -> std::array<double, 3> {
    return {1, 0, 0};
  };
  BreastProblem problem = hanging_body(box_mesh({6, 6, kLength}, {1, 1, 6}), fat, pull);
  UnloadOptions options;
  options.solid = {PressureSpace::trilinear, 1e6, 0};
  const UnloadResult result = unload(problem, options);
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  // Newton ends within 1e-7 of the forces: of 2 mm of sag 2e-7 mm, times how much softer the column
  // bends than it stretches, (L / d)^2 of about 44 (2.1e-6 mm on one make of processor, under
  // 1e-6 on another).
  EXPECT_LT(result.report.round_trip_max_mm, 1e-5);
  double length = 0;
  constexpr int points = 400;
  for (int k = 0; k < points; ++k)
    length += kLength / points / stretch_at(pull * kWeight * kLength * (1 - (k + 0.5) / points));
  EXPECT_LT(length, kLength - 1.9);
  const double found = result.unloaded.back()(2, 0) - result.unloaded.front()(2, 0);
  EXPECT_NEAR(found - kLength, length - kLength, 0.01 * (kLength - length));
}

// A block with a stiff lump: the same unloaded shape from a mesh twice as fine in each direction.
TEST(Unload, BlockConvergesUnderRefinement) {
  const auto lump = [](const Eigen::Vector3d& x, double) -> std::array<double, 3> {
    const double f = std::exp(-(x - Eigen::Vector3d(15, 20, 18)).squaredNorm() / (2 * 10 * 10));
    return {1 - f, f, 0};
  };
  const auto solve = [&](int n) {
    const HermiteMesh mesh = box_mesh({40, 40, 30}, {n, n, n});
    const UnloadResult result = unload(hanging_body(mesh, lump, 10), without_checks());
    EXPECT_TRUE(result.report.usable()) << result.report.reason;
    return result;
  };
  const UnloadResult coarse = solve(2), fine = solve(4);
  EXPECT_GT(fine.report.sag_max_mm, 2);
  double worst = 0;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        worst = std::max(worst, (coarse.unloaded[i + 3 * (j + 3 * k)].col(0) -
                                 fine.unloaded[2 * i + 5 * (2 * j + 5 * 2 * k)].col(0))
                                    .norm());
  EXPECT_LT(worst, 0.01 * fine.report.sag_max_mm);
}

// The other way to the same shape, which uses the forward solve alone: X − (x(X) − prone), again
// and again. It contracts by the strain, here by a third a round.
TEST(Unload, AgreesWithTheFixedPoint) {
  BreastProblem problem = dome_problem(60);
  problem.mesh = dome_breast({3, 3, 1});
  problem.gravity = {0, -9810 * 5, 0};
  const UnloadResult inverse = unload(problem, without_checks());
  ASSERT_TRUE(inverse.report.usable()) << inverse.report.reason;
  const auto& prone = problem.mesh.mesh.nodes();
  auto X = prone;
  double off = 1;
  int rounds = 0;
  for (; rounds < 40 && off > 1e-6; ++rounds) {
    const HangResult loaded = hang(from_unloaded(problem, X), {});
    ASSERT_TRUE(loaded.report.usable()) << loaded.report.reason;
    off = largest_distance(loaded.deformed, prone);
    for (std::size_t i = 0; i < X.size(); ++i) X[i] -= loaded.deformed[i] - prone[i];
  }
  EXPECT_LT(off, 1e-6);
  EXPECT_LT(largest_distance(X, inverse.unloaded), 1e-5);
  RecordProperty("rounds", rounds);
}

// A breast that gravity presses on the chest: its unloaded shape would be higher than it can stand.
// Only gravity over stiffness counts, so the share of gravity that works says what stiffness does.
TEST(Unload, TooSoftTissueIsSaidSoWithTheStiffnessThatWouldDo) {
  BreastProblem problem = dome_problem(60);
  problem.mesh = dome_breast({2, 2, 1});
  problem.gravity = {0, 9810 * 25, 0};
  const UnloadResult part = unload(problem, {});
  const UnloadReport& report = part.report;
  EXPECT_FALSE(report.usable());
  EXPECT_NE(report.reason, "");
  ASSERT_GT(report.gravity_fraction, 0);
  ASSERT_LT(report.gravity_fraction, 1);
  const double factor = report.sufficient_stiffness_factor();
  for (auto [law, c1] : {std::pair{0, 0.75}, {1, 2.5}, {2, 3.3}})
    problem.laws.laws[law] = std::make_shared<NeoHookean>(factor * c1);
  problem.skin.c1 *= factor;
  problem.boundary.chest_wall_spring *= factor;
  const UnloadResult stiffer = unload(problem, {});
  EXPECT_TRUE(stiffer.report.usable()) << stiffer.report.reason;
  EXPECT_LT(largest_distance(stiffer.unloaded, part.unloaded), 1e-6);
}

// A breast made with known stiffness hangs and lies; from the prone shape with stiffnesses that are
// off by a factor, the supine shape gives that factor back. The search stops within 2 %.
TEST(FitStiffness, FindsTheFactorFromASupineShape) {
  constexpr double true_factor = 0.6;
  BreastProblem prone = dome_problem(60);
  prone.mesh = dome_breast({2, 2, 1});
  const Eigen::Vector3d down(0, -9810, 0);
  prone.gravity = down / true_factor;
  const UnloadResult unloaded = unload(prone, without_checks());
  ASSERT_TRUE(unloaded.report.usable()) << unloaded.report.reason;
  BreastProblem supine = from_unloaded(prone, unloaded.unloaded);
  supine.gravity = -down / true_factor;
  const HangResult seen = hang(supine, {});
  ASSERT_TRUE(seen.report.usable()) << seen.report.reason;
  prone.gravity = down;
  const StiffnessFit fit = fit_stiffness(
      prone, -down, [&](const auto& x) { return largest_distance(x, seen.deformed); }, {});
  ASSERT_TRUE(fit.usable()) << fit.reason;
  EXPECT_NEAR(fit.factor / true_factor, 1, 0.02);
  EXPECT_LT(fit.distance_mm, 0.05 * fit.distance_at_one_mm);
}

}  // namespace
}  // namespace mammotwin::unload_test
