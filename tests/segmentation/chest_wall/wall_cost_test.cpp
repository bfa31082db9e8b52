#include "segmentation/chest_wall/wall_cost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

/// One ray of 120 mm in the body: up to sample 60 in turn a tenth above and below muscle (1.5),
/// fat (1) from there on.
PolarRays rough_ray() {
  PolarRays rays{1, 1, {}, {120}};
  for (int d = 0; d < PolarRays::depths; ++d)
    rays.intensity.push_back(d >= 60 ? 1.0F : d % 2 ? 1.6F : 1.4F);
  return rays;
}

TEST(WallCost, RisesByTwoWhereTheInsideIsThreeTimesAsRoughAsMuscle) {
  // Three of five samples on one side of the mean, two on the other, 0.1 to either side of 1.5:
  // variance 0.1^2 (1 - 1/25).
  const double deviation = 0.1 * std::sqrt(1 - 1.0 / 25);
  const PolarRays rays = rough_ray();
  const auto added = [&](double ratio) {
    const std::vector<float> known = wall_costs(rays, {{1, 1.5, deviation / ratio}});
    const std::vector<float> unknown = wall_costs(rays, {{1, 1.5, 0}});
    return known[60] - unknown[60];
  };
  EXPECT_NEAR(added(1.4), 0, 1e-4);  // costs are floats
  EXPECT_NEAR(added(2.25), 1, 1e-4) << "halfway from 1.5 to 3 times";
  EXPECT_NEAR(added(3), 2, 1e-4);
  EXPECT_NEAR(added(10), 2, 1e-4);
}

TEST(WallCost, IsLowestAtTheFrontOfMuscle) {
  const std::vector<float> cost = wall_costs(rough_ray(), {{1, 1.5, 0.1}});
  int best = 0;
  for (int d = 0; d < PolarRays::depths; ++d)
    if (cost[d] < cost[best]) best = d;
  EXPECT_EQ(best, 60) << "between the samples 59 and 60";
}

TEST(WallCost, IsLowestAtTheFrontOfMuscleUnderGlandThatIsKnown) {
  PolarRays rays{1, 1, {}, {120}};
  for (int d = 0; d < PolarRays::depths; ++d)
    rays.intensity.push_back(d < 60 ? 1.5F : d < 80 ? 1.9F : 1.0F);
  const auto best = [&](const WallContrast& contrast) {
    const std::vector<float> cost = wall_costs(rays, {contrast});
    return std::min_element(cost.begin(), cost.end()) - cost.begin();
  };
  EXPECT_EQ(best({1, 1.5, 0, 0}), 80) << "gland passes for muscle";
  EXPECT_EQ(best({1, 1.5, 0, 1.9, 0.05}), 60);
}

}  // namespace
}  // namespace mammotwin
