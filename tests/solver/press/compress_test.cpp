#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

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
