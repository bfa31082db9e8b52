#include <gtest/gtest.h>

#include <cmath>

#include "tests/solver/dome_breast.h"
#include "tests/verification/plate_under_block.h"

namespace mammotwin::friction_test {
namespace {

constexpr double kC1 = PlateUnderBlock::kC1, kCoefficient = PlateUnderBlock::kCoefficient;
constexpr double kSlip = PlateUnderBlock::kSlip;

// An endless strip, free at y = W, under compression λz = λ, λy = 1/λ and simple shear g: with
// σ_yy = 0, σ_zz = 2c₁(λz² − λy²) and σ_xz = 2c₁ λz g where x = X + gZ (σ = 2c₁B + q). Per
// reference area (x λy): normal 2c₁(λ − λ⁻³), shear 2c₁ g. So it sticks until g = μ(λ⁻³ − λ), and
// then no shear is added however far the plate goes.
TEST(Friction, StripSlidesAtTheClosedFormsShear) {
  const Eigen::Vector3d size(10, 8, 10);
  PlateUnderBlock strip(box_mesh(size, {2, 1, 2}), true);
  strip.press(2);
  const double area = size.x() * size.y();
  const auto height = [&] { return strip.state().x.back()(2, 0) - strip.state().x[0](2, 0); };
  const double stretch = height() / size.z();
  const double normal = 2 * kC1 * (std::pow(stretch, -3) - stretch) * area;
  // kappa/mu = 1e6 leaves the volume, and so the pressure, off by about 1e-6.
  EXPECT_NEAR(strip.force().z() / normal, 1, 1e-5);
  EXPECT_NEAR(strip.force().x(), 0, 1e-6 * normal);

  const double shear_limit = kCoefficient * (std::pow(stretch, -3) - stretch);
  const double drawn = 0.5 * shear_limit * size.z();
  strip.draw(drawn, 1);
  // Sticking: the plate's way is shear g H plus elastic slip s, where μ t h'(s) = 2c₁ g and so
  // s = δ (1 − √(1 − g/limit)): slowly growing, found by putting it in again.
  double shear = 0;
  for (int k = 0; k < 50; ++k)
    shear = (drawn - kSlip * (1 - std::sqrt(1 - shear / shear_limit))) / size.z();
  EXPECT_NEAR(strip.force().x() / (2 * kC1 * shear * area), 1, 1e-4);
  EXPECT_LT(strip.force().x(), kCoefficient * strip.force().z());

  strip.draw(2 * shear_limit * size.z(), 2);
  EXPECT_NEAR(strip.force().x() / strip.force().z(), kCoefficient, 1e-5);
  EXPECT_NEAR(strip.force().x() / (2 * kC1 * shear_limit * area), 1, 1e-4);
  // Drawn back it sticks again, then slides the other way.
  strip.draw(-4 * shear_limit * size.z(), 4);
  EXPECT_NEAR(strip.force().x() / strip.force().z(), -kCoefficient, 1e-5);
}

// A block of finite length bulges over the plate, so nothing is homogeneous: but once all of it
// slides one way each point's friction is μ of its own pressure, so the sums obey F = μN whatever
// the pressures; and what the plate gives, the held top takes.
TEST(Friction, BlockSlidesAtMuTimesTheNormalForce) {
  PlateUnderBlock block(box_mesh({10, 8, 6}, {2, 2, 2}), false);
  block.press(1);
  block.draw(0.1, 1);
  EXPECT_LT(block.force().x(), 0.5 * kCoefficient * block.force().z()) << "it sticks";
  block.draw(20, 8);
  // Slips still turn a little towards x at the last steps: second order in the angle.
  EXPECT_NEAR(block.force().x() / block.force().z(), kCoefficient, 1e-3 * kCoefficient);
  EXPECT_NEAR((block.force() + block.top_force()).tail<1>().norm(), 0, 1e-4 * block.force().z());
  EXPECT_NEAR(block.force().x() + block.top_force().x(), 0, 1e-4 * block.force().z());
}

CompressionResult dome(double coefficient) {
  CompressionProblem problem = dome_problem(85);
  problem.mesh = dome_breast({4, 4, 1});
  problem.friction.coefficient = coefficient;
  return compress(problem, {});
}

TEST(Friction, HoldsTheSkinOfABreastBack) {
  const CompressionResult free = dome(0), rough = dome(0.3);
  ASSERT_TRUE(free.report.usable()) << free.report.reason;
  ASSERT_TRUE(rough.report.usable()) << rough.report.reason;
  EXPECT_NEAR(rough.report.thickness_mm, 85, 0.1);
  EXPECT_GT(rough.report.force_N, 1.01 * free.report.force_N);
  // The contact's sum and the potential's derivative share no code; as without friction.
  EXPECT_NEAR(rough.report.energy_force_N / rough.report.force_N, 1, 1e-3);
}

}  // namespace
}  // namespace mammotwin::friction_test
