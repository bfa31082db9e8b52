#include "segmentation/chest_wall/wall_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "segmentation/chest_wall/wall_contrast.h"

namespace mammotwin {
namespace {

constexpr int rows = 40, angles = 40;

/// Rays that fall from `inside` to `outside` over 2 mm around `middle`, in a straight line: the
/// samples next to the middle lie on it, so it is met exactly.
PolarRays rays_with_step(double middle, double inside, double outside) {
  PolarRays rays{rows, angles, {}, std::vector<int>(rows * angles, 150)};
  for (int n = 0; n < rows * angles; ++n)
    for (int d = 0; d < PolarRays::depths; ++d) {
      const double t = std::clamp((d - middle + 1) / 2, 0.0, 1.0);
      rays.intensity.push_back(static_cast<float>(inside + t * (outside - inside)));
    }
  return rays;
}

TEST(WallRefinement, MovesTheWallToTheMiddleOfTheStep) {
  const std::vector<WallContrast> contrast(rows * angles, {1, 1.5});
  const std::vector<double> depth(rows * angles, 61.5);
  for (const double d : refined_depths(rays_with_step(60.3, 1.5, 1), depth, contrast))
    EXPECT_NEAR(d, 60.3, 1e-5);  // rounding of float intensities
  const std::vector<WallContrast> dark(rows * angles, {1, 0.4});
  for (const double d : refined_depths(rays_with_step(60.3, 0.4, 1), depth, dark))
    EXPECT_NEAR(d, 60.3, 1e-5);
}

TEST(WallRefinement, StaysWithoutStepOrBeforeAWrongOne) {
  const std::vector<WallContrast> contrast(rows * angles, {1, 1.5});
  const std::vector<double> depth(rows * angles, 61.5);
  EXPECT_EQ(refined_depths(rays_with_step(60.3, 1.5, 1.4), depth, contrast), depth)
      << "a fifth of the step from fat to muscle";
  EXPECT_EQ(refined_depths(rays_with_step(60.3, 1.5, 1.8), depth, contrast), depth)
      << "brighter outside";
}

TEST(WallContrast, IsMeasuredWhereTheImageSupportsTheWall) {
  const std::vector<double> depth(rows * angles, 60);
  const PolarRays rays = rays_with_step(60, 1.4, 0.8);
  for (const WallContrast& c :
       local_contrasts(rays, depth, std::vector<float>(rows * angles, -2), {1, 1.6})) {
    EXPECT_NEAR(c.fat, 0.8, 1e-6);
    EXPECT_NEAR(c.muscle, 1.4, 1e-6);
  }
  for (const WallContrast& c :
       local_contrasts(rays, depth, std::vector<float>(rows * angles, 0), {1, 1.6})) {
    EXPECT_EQ(c.fat, 1);
    EXPECT_EQ(c.muscle, 1.6);
  }
}

/// Rays of muscle (1.5, one sample in two brighter by `mix`) up to 60 and fat, with gland of 2 over
/// 35 mm of it in every third.
PolarRays rays_under_gland(float mix) {
  PolarRays rays{rows, angles, {}, std::vector<int>(rows * angles, 150)};
  for (int n = 0; n < rows * angles; ++n)
    for (int d = 0; d < PolarRays::depths; ++d)
      rays.intensity.push_back(d < 60                 ? 1.5F + static_cast<float>(d % 2) * mix
                               : n % 3 == 0 && d < 95 ? 2.0F
                                                      : 1.0F);
  return rays;
}

TEST(WallContrast, KnowsGlandThatDiffersFromMuscleMoreThanMuscleFromItself) {
  const std::vector<double> depth(rows * angles, 60);
  const std::vector<float> cost(rows * angles, -2);
  for (const WallContrast& c : local_contrasts(rays_under_gland(0.05F), depth, cost, {1, 1.55})) {
    EXPECT_NEAR(c.gland, 2, 1e-5);
    EXPECT_NEAR(c.spread, 0.05, 1e-9) << "the least";
  }
  for (const WallContrast& c : local_contrasts(rays_under_gland(0.5F), depth, cost, {1, 1.55}))
    EXPECT_EQ(c.gland, 0) << "muscle of 1.5 and 2";
}

}  // namespace
}  // namespace mammotwin
