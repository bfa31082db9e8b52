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
  std::optional<CoilRelease> taken = release;
  const UnloadResult unloaded = unload_released(imaged, *sides, taken);
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->fit.way_mm, release->fit.way_mm);
  EXPECT_EQ(imaged.pressed.way_mm, release->fit.way_mm);
  ASSERT_TRUE(unloaded.report.usable()) << unloaded.report.reason;
  EXPECT_LT(unloaded.report.round_trip_max_mm, 1e-6);
  const Roundness roundness(imaged.mesh, sides->across);
  EXPECT_NEAR(roundness.of(imaged.mesh.mesh.nodes()), 0.35, 1e-6);
  EXPECT_NEAR(roundness.of(unloaded.unloaded), 0.5, 0.001);
  const double as_found = roundness.of(unloaded.unloaded);
  EXPECT_NEAR(roundness.of(rounder_shape(imaged, *sides, unloaded, 1, 0.02)), as_found + 0.02,
              1e-3);

  imaged.pressed.way_mm += 1;
  const UnloadResult farther = unload(imaged, {});
  const double more = roundness.of(farther.unloaded) - as_found;
  imaged.pressed.way_mm -= 1;
  const auto rounder = rounder_shape(imaged, *sides, unloaded, 1, more);
  EXPECT_LT(largest_distance(rounder, farther.unloaded),
            0.1 * largest_distance(unloaded.unloaded, farther.unloaded))
      << "to first order";
}

TEST(CoilRelease, IsNoFartherThanTheBreastHangsAsImaged) {
  BreastProblem imaged = pressed_problem();
  const auto sides = find_pressed_sides(imaged.mesh);
  const Roundness roundness(imaged.mesh, sides->across);
  std::optional<CoilRelease> release = release_from_coil(imaged, *sides, 0.5);
  const double too_far_mm = 8 * release->fit.way_mm, much_too_far_mm = 1e5;
  release->pressed.way_mm = too_far_mm;
  const UnloadResult less = unload_released(imaged, *sides, release);
  ASSERT_TRUE(less.report.usable());
  ASSERT_TRUE(release);
  EXPECT_LT(release->fit.way_mm, too_far_mm);
  EXPECT_EQ(imaged.pressed.way_mm, release->fit.way_mm);
  EXPECT_EQ(release->fit.figure, roundness.of(less.unloaded));
  EXPECT_EQ(release->fit.reason, "it would not hang as imaged");
  release->pressed.way_mm = much_too_far_mm;
  const UnloadResult kept = unload_released(imaged, *sides, release);
  EXPECT_TRUE(kept.report.usable());
  EXPECT_FALSE(release) << "and so it stays as narrow";
  EXPECT_FALSE(imaged.pressed);
}

TEST(CoilRelease, LetsABreastGoTheLessTheRounderItIsUnlessItsRoundnessIsSaid) {
  BreastProblem imaged = pressed_problem();
  imaged.mesh = pressed_breast(0, 0, 55);  // half of the way from 0.6 to 0.5
  const auto round_free_of_load = [&](std::optional<double> said) {
    return release_from_coil(imaged, *find_pressed_sides(imaged.mesh), said)->fit.figure;
  };
  EXPECT_NEAR(round_free_of_load({}), (0.55 + 0.8) / 2, 0.001);
  EXPECT_NEAR(round_free_of_load(0.75), 0.75, 0.001);
}

TEST(CoilRelease, LeavesABreastThatIsAsRoundAlreadyOrNotFlat) {
  BreastProblem imaged = pressed_problem();
  EXPECT_FALSE(release_from_coil(imaged, *find_pressed_sides(imaged.mesh), 0.3));
  imaged.mesh = pressed_breast(0, 0, 62);  // between plates, and 0.62 times as wide as high
  EXPECT_FALSE(release_from_coil(imaged, *find_pressed_sides(imaged.mesh), {}));
}

}  // namespace
}  // namespace mammotwin
