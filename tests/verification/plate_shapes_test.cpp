#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/scratch_file.h"
#include "tests/solver/dome_breast.h"

namespace mammotwin::plate_shapes_test {
namespace {

CompressionProblem coarse_dome() {
  CompressionProblem problem = dome_problem(60);
  problem.mesh = dome_breast({4, 4, 2});
  return problem;
}

const CompressionResult& between_level_plates() {
  static const CompressionResult result = compress(coarse_dome(), {});
  return result;
}

/// Largest depth of the skin inside a plate, at points that contact does not know: between its own.
double deepest(const MeshFile& mesh, const CompressionResult& result) {
  const HermiteMesh deformed(result.deformed, mesh.mesh.elements());
  double deepest = 0;
  for (int e = 0; e < deformed.num_elements(); ++e)
    for (int k = 0; k <= 30 * 31; ++k) {
      if (mesh.faces[e][5] != FaceLabel::skin) continue;
      const Eigen::Vector3d x = deformed.position({e, {k % 31 / 30.0, k / 31 / 30.0, 1.0}});
      for (const Plate& plate : {result.plates.support, result.plates.paddle})
        deepest = std::max(deepest, -plate.gap(x).gap);
    }
  return deepest;
}

void expect_good(const CompressionProblem& problem, const CompressionResult& result) {
  const CompressionReport& report = result.report;
  ASSERT_TRUE(report.usable()) << report.reason;
  EXPECT_NEAR(report.thickness_mm, problem.plates.thickness, 0.1);
  EXPECT_LT(report.mean_gap_mm, 0.2);
  // The contact's sum and the potential's derivative share no code.
  EXPECT_NEAR(report.energy_force_N / report.force_N, 1, 1e-3);
  // Faces of 35 mm bridge an edge of 10 mm between contact points 4.4 mm apart, and 5 mm where the
  // edge has stretched them, by up to 5²/(8·10) = 0.31 mm beside the points' own 0.05 mm.
  EXPECT_LT(deepest(problem.mesh, result), 0.36);
}

TEST(PlateShapes, ATiltedPaddleThinsTheFront) {
  CompressionProblem problem = coarse_dome();
  problem.plates.paddle_tilt = 5;
  const CompressionResult tilted = compress(problem, {});
  expect_good(problem, between_level_plates());
  expect_good(problem, tilted);
  EXPECT_EQ(tilted.report.paddle_tilt_deg, 5);
}

// A flexible paddle ends where its spring holds the contact's moment about an axis 200 mm in front
// of the edge: the force times an arm between 200 mm and 200 mm less the breast's depth of 70 mm,
// and something more because the rounded edge and the wall behind it are pushed forwards, too.
// Locked at that tilt, a rigid paddle carries the same force.
TEST(PlateShapes, AFlexiblePaddleTiltsUntilItsSpringBalancesTheBreast) {
  CompressionProblem problem = coarse_dome();
  problem.plates.tilt_spring = 0.2e6;  // 0.2 N m per degree
  const CompressionResult result = compress(problem, {});
  expect_good(problem, result);
  const double moment = 0.2 * result.report.paddle_tilt_deg;  // [N m]
  EXPECT_LT(moment, 0.250 * result.report.force_N);
  EXPECT_GT(moment, 0.130 * result.report.force_N);
  problem.plates.tilt_spring = PlateOptions::kEndless;
  problem.plates.paddle_tilt = result.report.paddle_tilt_deg;
  const CompressionResult rigid = compress(problem, {});
  expect_good(problem, rigid);
  EXPECT_NEAR(rigid.report.force_N / result.report.force_N, 1, 0.01);
}

TEST(PlateShapes, TheBreastBulgesPastANarrowPlate) {
  CompressionProblem problem = coarse_dome();
  problem.plates.width = 70;
  const CompressionResult result = compress(problem, {});
  expect_good(problem, result);
  double highest = 0;  // of the skin beside the plate, over its face
  for (const auto& node : result.deformed)
    highest = std::max(highest, node(2, 0) - result.plates.paddle_height);
  EXPECT_GT(highest, 1) << "tissue beside the plate stays above its face";
}

TEST(PlateShapes, FacetsOfAFlatPlateDoAsTheFlatPlate) {
  const auto path = scratch_file("plate.stl");
  std::ofstream out(path);
  out << "solid plate\n";
  const auto strip = [&](double x0, double z0, double x1, double z1) {
    const double y = 150;
    for (int half = 0; half < 2; ++half)
      out << "facet normal 0 0 0\nouter loop\nvertex " << x0 << ' ' << -y << ' ' << z0
          << "\nvertex " << x1 << ' ' << (half ? y : -y) << ' ' << z1 << "\nvertex "
          << (half ? x0 : x1) << ' ' << y << ' ' << (half ? z0 : z1) << "\nendloop\nendfacet\n";
  };
  constexpr double r = 10;
  constexpr int arcs = 12;
  const auto angle = [](int k) { return 1.5707963267948966 * k / arcs; };
  strip(0, -60, 0, -r);
  for (int k = 0; k < arcs; ++k)
    strip(r - r * std::cos(angle(k)), -r + r * std::sin(angle(k)), r - r * std::cos(angle(k + 1)),
          -r + r * std::sin(angle(k + 1)));
  strip(r, 0, 150, 0);
  out << "endsolid plate\n";
  out.close();
  CompressionProblem problem = coarse_dome();
  const CompressionResult& flat = between_level_plates();
  problem.plates.paddle_mesh = std::make_shared<PlateMesh>(PlateMesh::read(path));
  problem.plates.support_mesh = problem.plates.paddle_mesh;
  const CompressionResult facets = compress(problem, {});
  expect_good(problem, facets);
  // Arcs of 7.5 degrees lie up to 0.02 mm inside the rounding, whose curvature begins within h; and
  // the two end with penetrations between 0 and 0.05 mm, which shift the force by 0.2 % per 0.01
  // mm.
  EXPECT_NEAR(facets.report.force_N / flat.report.force_N, 1, 0.02);
  for (std::size_t i = 0; i < flat.deformed.size(); ++i)
    EXPECT_NEAR((facets.deformed[i].col(0) - flat.deformed[i].col(0)).norm(), 0, 0.5);
}

TEST(PlateShapes, WithoutFrictionItDoesNotMatterWhichPlateMoves) {
  CompressionProblem problem = coarse_dome();
  CompressionOptions options;
  options.first_step = 0.5;
  const CompressionResult& both = between_level_plates();
  options.moving = Moving::paddle;
  const CompressionResult one = compress(problem, options);
  expect_good(problem, one);
  // Both ends are corrected to 0.02 mm of thickness and 0.05 mm of penetration.
  for (std::size_t i = 0; i < both.deformed.size(); ++i)
    EXPECT_NEAR((one.deformed[i].col(0) - both.deformed[i].col(0)).norm(), 0, 0.2);
}

}  // namespace
}  // namespace mammotwin::plate_shapes_test
