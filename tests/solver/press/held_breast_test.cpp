#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "solver/gravity/unload.h"
#include "tests/solver/dome_breast.h"

// What holds a breast between the plates: friction, and the pull of the hands.

namespace mammotwin {
namespace {

/// Plates far from the chest wall, hardly any springs, 0.8 of the thickness: nothing but friction
/// holds the breast between them.
CompressionProblem loosely_held(double friction) {
  CompressionProblem problem = dome_problem(22, false);
  problem.mesh = dome_breast({3, 3, 1});
  problem.boundary.chest_wall_spring = 0.01;
  problem.plates.wall_clearance = 25;
  problem.friction.coefficient = friction;
  return problem;
}

TEST(HeldBreast, SaysThatABreastSlippedOutAndDoesNotHoldItByItself) {
  const CompressionReport lost = compress(loosely_held(0), {}).report;
  EXPECT_FALSE(lost.usable());
  EXPECT_TRUE(lost.slipped_out);
  EXPECT_NE(lost.reason.find("slipped out backwards"), std::string::npos) << lost.reason;
}

TEST(HeldBreast, FrictionHoldsABreastThatWouldSlipOut) {
  const CompressionReport held = compress(loosely_held(0.2), {}).report;
  ASSERT_TRUE(held.usable()) << held.reason;
  EXPECT_NEAR(held.thickness_mm, 22, 0.1);
  EXPECT_GT(held.retained_fraction, 0.5);
}

// Friction's holds come with the result. With them the same problem is in balance where it was, to
// the tolerance of friction's pressures (0.0013 mm); without them the skin springs back (0.07 mm).
TEST(HeldBreast, GoesOnFromAResultAsFrictionHeldIt) {
  CompressionProblem problem = dome_problem(60);
  problem.mesh = dome_breast({3, 3, 1});
  problem.friction.coefficient = 0.3;
  const CompressionResult whole = compress(problem, {});
  ASSERT_TRUE(whole.report.usable()) << whole.report.reason;
  ASSERT_FALSE(whole.holds.empty());
  CompressionOptions plates_stay;
  plates_stay.thickness_tolerance = 1e3;
  plates_stay.gap_tolerance = 0.5;
  const auto move_of = [&](const CompressionResult& near) {
    const CompressionResult again = compress_from(near, problem, plates_stay);
    EXPECT_TRUE(again.report.usable()) << again.report.reason;
    double move = 0;
    for (std::size_t i = 0; i < whole.deformed.size(); ++i)
      move = std::max(move, (again.deformed[i] - whole.deformed[i]).col(0).norm());
    return move;
  };
  CompressionResult forgotten = whole;
  forgotten.holds.clear();
  const double with = move_of(whole), without = move_of(forgotten);
  EXPECT_GT(without, 0.03);
  EXPECT_LT(with, 0.1 * without);
}

double largest_distance(const std::vector<HermiteMesh::Node>& a,
                        const std::vector<HermiteMesh::Node>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i] - b[i]).col(0).norm());
  return largest;
}

/// A dome that was imaged hanging under five times its weight, drawn forward by as much.
CompressionProblem drawn_forward() {
  constexpr double heavy = 5 * 9810;  // [mm/s²]
  CompressionProblem problem = dome_problem(60);
  problem.mesh = dome_breast({3, 3, 1});
  problem.gravity = heavy * problem.plates.depth;
  const UnloadResult free = unload(problem, {});
  EXPECT_TRUE(free.report.usable()) << free.report.reason;
  static_cast<BreastProblem&>(problem) = from_unloaded(problem, free.unloaded);
  problem.pull = problem.density * problem.gravity;
  problem.gravity.setZero();
  return problem;
}

TEST(HeldBreast, APullOfItsWeightHoldsTheBreastAsItHung) {
  const CompressionProblem problem = drawn_forward();
  const CompressionResult result = compress(problem, {});
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  EXPECT_GT(largest_distance(problem.mesh.mesh.nodes(), problem.prone), 3);
  EXPECT_LT(largest_distance(result.found, problem.prone), 1e-3);
}

// The breast is to be so thick, not the plates so far apart: tissue stands inside them.
TEST(HeldBreast, LoadStepsEndNearTheThicknessAsked) {
  CompressionProblem problem = drawn_forward();
  problem.friction.coefficient = 0.3;
  problem.plates.thickness = 30;
  const CompressionResult result = compress(problem, {});
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  ASSERT_GE(result.report.history.size(), 2u);
  EXPECT_NEAR(result.report.history.back().thickness_mm, 30, 0.5);
}

// As where a coil's plates pressed it while it was imaged.
TEST(HeldBreast, ABreastThatDoesNotLieAsItWasImagedComesToRest) {
  CompressionProblem problem = drawn_forward();
  const std::vector<HermiteMesh::Node> hanging = problem.prone;
  for (auto& node : problem.prone) node.row(0) *= 0.9;
  const CompressionResult result = compress(problem, {});
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  EXPECT_GT(largest_distance(problem.prone, hanging), 3);
  EXPECT_LT(largest_distance(result.found, hanging), 1);
}

// Without it this one slips out.
TEST(HeldBreast, APullHoldsTheBreastBetweenThePlates) {
  constexpr double weight = 9.81e-3;  // [mN/mm³]
  CompressionProblem problem = loosely_held(0);
  problem.pull = 5 * weight * problem.plates.depth;
  const CompressionResult result = compress(problem, {});
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  EXPECT_NEAR(result.report.energy_force_N / result.report.force_N, 1, 1e-3);
  const CompressionResult again = compress_from(result, problem, {});
  ASSERT_TRUE(again.report.usable()) << again.report.reason;
  EXPECT_LT(largest_distance(result.deformed, again.deformed), 0.05);
}

TEST(HeldBreast, ABreastThatSlipsOutIsDrawnHarder) {
  constexpr double weight = 9.81e-3;  // [mN/mm³]
  CompressionProblem problem = loosely_held(0);
  problem.pull = 1.5 * weight * problem.plates.depth;
  CompressionOptions options;
  options.most_drawn = 1;
  const CompressionResult out = compress(problem, options);
  EXPECT_FALSE(out.report.usable());
  EXPECT_LT(out.report.retained_fraction, options.well_retained);
  std::vector<std::string> said;
  const CompressionResult held =
      compress(problem, {}, [&](double, const std::string& what) { said.push_back(what); });
  ASSERT_TRUE(held.report.usable()) << held.report.reason;
  EXPECT_GT(held.report.drawn_times, 1);
  EXPECT_GT(held.report.presses, 1);
  EXPECT_GT(held.report.retained_fraction, out.report.retained_fraction);
  EXPECT_NE(said.back().find("times as hard"), std::string::npos);
  problem.pull *= held.report.drawn_times;
  const CompressionResult again = compress_from(held, problem, {});
  ASSERT_TRUE(again.report.usable()) << again.report.reason;
  EXPECT_LT(largest_distance(held.deformed, again.deformed), 0.05);
}

TEST(HeldBreast, SaysThatDrawingHarderDoesNotHoldABreast) {
  CompressionProblem problem = loosely_held(0);
  problem.pull = 1e-6 * problem.plates.depth;
  const CompressionResult result = compress(problem, {});
  EXPECT_FALSE(result.report.usable());
  EXPECT_EQ(result.report.presses, 3);
  EXPECT_EQ(result.report.drawn_times, 1);
  EXPECT_NE(result.report.reason.find(", also drawn 4 times as hard"), std::string::npos)
      << result.report.reason;
}

}  // namespace
}  // namespace mammotwin
