#include "pipeline/steps/coil_release.h"

#include <gtest/gtest.h>

#include "tests/pipeline/steps/pressed_breast.h"

namespace mammotwin {
namespace {

/// Pressed to a third of its height, hanging under half of its weight.
BreastProblem pressed_problem() {
  BreastProblem problem = dome_problem(60);
  problem.mesh = pressed_breast(0, 0, 35);
  problem.gravity = {0, -4900, 0};
  return problem;
}

TEST(CoilRelease, MakesTheBreastAsRoundAsAskedAndOneThatIsRounder) {
  BreastProblem imaged = pressed_problem();
  const auto sides = find_pressed_sides(imaged.mesh);
  ASSERT_TRUE(sides);
  const auto release = release_from_coil(imaged, *sides, 0.5);
  ASSERT_TRUE(release);
  EXPECT_EQ(release->fit.reason, "");
  imaged.pressed = release->pressed;
  const UnloadResult unloaded = unload(imaged, {});
  ASSERT_TRUE(unloaded.report.usable()) << unloaded.report.reason;
  EXPECT_LT(unloaded.report.round_trip_max_mm, 1e-6);
  const Roundness roundness(imaged.mesh, sides->across);
  EXPECT_NEAR(roundness.of(imaged.mesh.mesh.nodes()), 0.35, 1e-6);
  EXPECT_NEAR(roundness.of(unloaded.unloaded), 0.5, 0.011);
  const auto rounder = rounder_shape(pressed_problem(), *sides, *release, 0.1);
  ASSERT_FALSE(rounder.empty());
  EXPECT_NEAR(roundness.of(rounder), release->fit.figure + 0.1, 0.011);
}

TEST(CoilRelease, LeavesABreastThatIsAsRoundAlready) {
  const BreastProblem imaged = pressed_problem();
  EXPECT_FALSE(release_from_coil(imaged, *find_pressed_sides(imaged.mesh), 0.3));
}

}  // namespace
}  // namespace mammotwin
