#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "solver/gravity/unload.h"
#include "solver/material/neo_hookean.h"
#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

/// A coarse dome in one place, so that the tests of figures share one solve.
const CompressionProblem& squeezed_problem() {
  static const CompressionProblem problem = [] {
    CompressionProblem p = dome_problem(60);
    p.mesh = dome_breast({4, 4, 2});
    return p;
  }();
  return problem;
}

const CompressionResult& squeezed() {
  static const CompressionResult result = compress(squeezed_problem(), {});
  return result;
}

TEST(Compress, ReachesTheThicknessAsked) {
  const CompressionReport& report = squeezed().report;
  ASSERT_TRUE(report.usable()) << report.reason;
  EXPECT_NEAR(report.thickness_mm, 60, 0.1);
  EXPECT_LE(report.mean_gap_mm, CompressionOptions().gap_tolerance);
  EXPECT_LE(report.max_penetration_mm, 0.5);
  EXPECT_LT(report.wall_gap_mm, 0.2);
  EXPECT_LT(std::abs(report.volume_change), 0.01);
  EXPECT_EQ(report.J_within_half, 1);
  EXPECT_FALSE(report.history.empty());
}

// The paddle's force is the derivative of the stored energy: the two sums share no code beyond the
// elements. Central differences at 0.02 mm leave a relative 1e-4.
TEST(Compress, ForceFromContactIsForceFromEnergy) {
  const CompressionReport& report = squeezed().report;
  ASSERT_TRUE(report.usable()) << report.reason;
  EXPECT_GT(report.force_N, 1);
  EXPECT_NEAR(report.energy_force_N / report.force_N, 1, 1e-3);
}

TEST(Compress, StopsWhereThePaddlePressesWithTheMostForce) {
  ASSERT_TRUE(squeezed().report.usable());
  for (const double share : {0.3, 0.6, 1.5}) {
    CompressionProblem gentle = squeezed_problem();
    gentle.most_force = share * squeezed().report.force_N;
    const CompressionResult result = compress(gentle, {});
    const CompressionReport& report = result.report;
    ASSERT_TRUE(report.usable()) << report.reason;
    EXPECT_EQ(report.stopped_by_force, share < 1);
    EXPECT_NEAR(report.thickness_mm, report.target_thickness_mm, 0.1);
    if (share > 1) {
      EXPECT_EQ(report.target_thickness_mm, 60);
      continue;
    }
    EXPECT_NEAR(report.force_N, gentle.most_force, 0.1 * gentle.most_force);
    CompressionProblem known = squeezed_problem();
    known.plates.thickness = report.target_thickness_mm;
    const CompressionResult there = compress(known, {});
    ASSERT_TRUE(there.report.usable());
    EXPECT_NEAR(there.report.force_N, report.force_N, 0.01 * report.force_N);
    EXPECT_LE(report.newton_iterations, 2 * there.report.newton_iterations);
  }
}

TEST(Compress, IsTheSameInARotatedWorld) {
  const Eigen::Matrix3d R(Eigen::AngleAxisd(0.8, Eigen::Vector3d(0.2, 1, -0.5).normalized()));
  CompressionProblem turned = squeezed_problem();
  auto nodes = turned.mesh.mesh.nodes();
  for (auto& node : nodes) node = (R * node).eval();
  turned.mesh.mesh = HermiteMesh(nodes, turned.mesh.mesh.elements());
  turned.plates.up = R * turned.plates.up;
  turned.plates.depth = R * turned.plates.depth;
  const TissueSampler here = squeezed_problem().tissue;
  turned.tissue = [here, R](const Eigen::Vector3d& x, double v) {
    return here(R.transpose() * x, v);
  };
  const CompressionResult result = compress(turned, {});
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  // Both stop within 1e-8 of balance; the paddle's height is corrected to 0.02 mm.
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_NEAR((result.deformed[i].col(0) - R * squeezed().deformed[i].col(0)).norm(), 0, 1e-4);
}

// What small changes do: at a softer penalty, and with the plates where they are put, so that the
// thickness comes out. The plates' distance enters as the thickness asked.
TEST(Compress, FromANearbyResultFollowsThePlates) {
  CompressionResult start = squeezed();
  ASSERT_TRUE(start.report.usable());
  start.penalty /= 10;
  CompressionOptions options;
  options.gap_tolerance = 0.5;
  options.thickness_tolerance = 5;
  const CompressionResult here = compress_from(start, squeezed_problem(), options);
  CompressionProblem thinner = squeezed_problem();
  thinner.plates.thickness -= 2;
  const CompressionResult there = compress_from(here, thinner, options);
  ASSERT_TRUE(here.report.usable()) << here.report.reason;
  ASSERT_TRUE(there.report.usable()) << there.report.reason;
  EXPECT_LT(there.report.newton_iterations, 20);  // from rest 60
  EXPECT_NEAR(here.report.thickness_mm, 60,
              0.5);  // softer contact by a penetration of at most that
  EXPECT_NEAR(here.plates.paddle_height - here.plates.support_height -
                  (there.plates.paddle_height - there.plates.support_height),
              2, 1e-9);
  EXPECT_LT(there.report.thickness_mm, here.report.thickness_mm - 0.5);
  EXPECT_GT(there.report.force_N, here.report.force_N);
}

std::string refusal(const CompressionProblem& problem) {
  try {
    compress(problem, {});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Compress, RefusesAThicknessThatIsNone) {
  for (double thickness : {0.0, -5.0, 500.0, std::numeric_limits<double>::quiet_NaN()}) {
    CompressionProblem problem = squeezed_problem();
    problem.plates.thickness = thickness;
    EXPECT_NE(refusal(problem).find("thickness is"), std::string::npos) << thickness;
  }
}

TEST(Compress, RefusesAFoldedMesh) {
  CompressionProblem problem = squeezed_problem();
  auto nodes = problem.mesh.mesh.nodes();
  std::swap(nodes[12], nodes[13]);
  problem.mesh.mesh = HermiteMesh(nodes, problem.mesh.mesh.elements());
  EXPECT_NE(refusal(problem).find("folded"), std::string::npos);
}

TEST(Compress, RefusesNumbersThatAreNotFinite) {
  CompressionProblem problem = squeezed_problem();
  auto nodes = problem.mesh.mesh.nodes();
  nodes[3](1, 0) = std::numeric_limits<double>::quiet_NaN();
  problem.mesh.mesh = HermiteMesh(nodes, problem.mesh.mesh.elements());
  EXPECT_NE(refusal(problem).find("not a finite number"), std::string::npos);
}

TEST(Compress, RefusesABreastThatNothingHolds) {
  CompressionProblem problem = squeezed_problem();
  for (auto& labels : problem.mesh.faces)
    for (auto& label : labels)
      if (label == FaceLabel::chest_wall) label = FaceLabel::interior;
  EXPECT_NE(refusal(problem).find("nothing holds the breast"), std::string::npos);
}

TEST(Compress, RefusesPlatesThatNeverTouch) {
  CompressionProblem problem = squeezed_problem();
  problem.plates.wall_clearance = 200;
  EXPECT_NE(refusal(problem).find("plates never touch"), std::string::npos);
  problem = squeezed_problem();
  problem.plates.lift = 300;
  EXPECT_NE(refusal(problem).find("plates never touch"), std::string::npos);
}

TEST(Compress, RefusesStiffnessThatIsNotPositive) {
  CompressionProblem problem = squeezed_problem();
  problem.skin.c1 = -1;
  EXPECT_NE(refusal(problem).find("c1 (skin)"), std::string::npos);
  problem = squeezed_problem();
  problem.boundary.chest_wall_spring = -0.02;
  EXPECT_NE(refusal(problem).find("chest-wall spring"), std::string::npos);
}

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

TEST(Compress, SaysThatABreastSlippedOutAndDoesNotHoldItByItself) {
  const CompressionReport lost = compress(loosely_held(0), {}).report;
  EXPECT_FALSE(lost.usable());
  EXPECT_TRUE(lost.slipped_out);
  EXPECT_NE(lost.reason.find("slipped out backwards"), std::string::npos) << lost.reason;
}

TEST(Compress, FrictionHoldsABreastThatWouldSlipOut) {
  const CompressionReport held = compress(loosely_held(0.2), {}).report;
  ASSERT_TRUE(held.usable()) << held.reason;
  EXPECT_NEAR(held.thickness_mm, 22, 0.1);
  EXPECT_GT(held.retained_fraction, 0.5);
}

// Friction's holds come with the result. With them the same problem is in balance where it was, to
// the tolerance of friction's pressures (0.0013 mm); without them the skin springs back (0.07 mm).
TEST(Compress, GoesOnFromAResultAsFrictionHeldIt) {
  CompressionProblem problem = squeezed_problem();
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
  CompressionProblem problem = squeezed_problem();
  problem.mesh = dome_breast({3, 3, 1});
  problem.gravity = heavy * problem.plates.depth;
  const UnloadResult free = unload(problem, {});
  EXPECT_TRUE(free.report.usable()) << free.report.reason;
  static_cast<BreastProblem&>(problem) = from_unloaded(problem, free.unloaded);
  problem.pull = problem.density * problem.gravity;
  problem.gravity.setZero();
  return problem;
}

TEST(Compress, APullOfItsWeightHoldsTheBreastAsItHung) {
  const CompressionProblem problem = drawn_forward();
  const CompressionResult result = compress(problem, {});
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  EXPECT_GT(largest_distance(problem.mesh.mesh.nodes(), problem.prone), 3);
  EXPECT_LT(largest_distance(result.found, problem.prone), 1e-3);
}

// The breast is to be so thick, not the plates so far apart: tissue stands inside them.
TEST(Compress, LoadStepsEndNearTheThicknessAsked) {
  CompressionProblem problem = drawn_forward();
  problem.friction.coefficient = 0.3;
  problem.plates.thickness = 30;
  const CompressionResult result = compress(problem, {});
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  ASSERT_GE(result.report.history.size(), 2u);
  EXPECT_NEAR(result.report.history.back().thickness_mm, 30, 0.5);
}

// As where a coil's plates pressed it while it was imaged.
TEST(Compress, ABreastThatDoesNotLieAsItWasImagedComesToRest) {
  CompressionProblem problem = drawn_forward();
  const std::vector<HermiteMesh::Node> hanging = problem.prone;
  for (auto& node : problem.prone) node.row(0) *= 0.9;
  const CompressionResult result = compress(problem, {});
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  EXPECT_GT(largest_distance(problem.prone, hanging), 3);
  EXPECT_LT(largest_distance(result.found, hanging), 1);
}

// Without it this one slips out.
TEST(Compress, APullHoldsTheBreastBetweenThePlates) {
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

TEST(Compress, ABreastThatSlipsOutIsDrawnHarder) {
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

TEST(Compress, SaysThatDrawingHarderDoesNotHoldABreast) {
  CompressionProblem problem = loosely_held(0);
  problem.pull = 1e-6 * problem.plates.depth;
  const CompressionResult result = compress(problem, {});
  EXPECT_FALSE(result.report.usable());
  EXPECT_EQ(result.report.presses, 3);
  EXPECT_EQ(result.report.drawn_times, 1);
  EXPECT_NE(result.report.reason.find(", also drawn 4 times as hard"), std::string::npos)
      << result.report.reason;
}

TEST(Compress, SaysHowFarItCameWhereItCannotGoOn) {
  CompressionProblem problem = squeezed_problem();
  CompressionOptions options;
  options.first_step = 0.2;
  options.max_iterations = 1;  // one failed attempt, after good ones or none
  problem.plates.thickness = 5;
  const CompressionResult result = compress(problem, options);
  EXPECT_FALSE(result.report.usable());
  EXPECT_NE(result.report.reason.find("stopped at"), std::string::npos);
}

TEST(Compress, PressesOnceMoreWhatItCannotBringThere) {
  CompressionOptions options;
  options.max_iterations = 8;  // of the load steps of each press
  std::vector<std::string> said;
  const CompressionResult result = compress(
      squeezed_problem(), options, [&](double, const std::string& what) { said.push_back(what); });
  EXPECT_FALSE(result.report.usable());
  EXPECT_EQ(result.report.presses, 2);
  EXPECT_GT(result.report.newton_iterations, 8);
  EXPECT_NE(said.back().find("once more, carefully"), std::string::npos);
  EXPECT_EQ(squeezed().report.presses, 1);
}

}  // namespace
}  // namespace mammotwin
