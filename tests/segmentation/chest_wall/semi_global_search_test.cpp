#include "segmentation/chest_wall/semi_global_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mammotwin {
namespace {

/// A ramp of depth 10 + row / 2 + column / 4 that is 1 cheaper than anything else, under noise.
double ramp(int row, int column) { return 10 + 0.5 * row + 0.25 * column; }

std::vector<float> cost_of_ramp(int rows, int columns, int depths, double noise) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<float> cost;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      for (int d = 0; d < depths; ++d)
        cost.push_back(static_cast<float>(std::min(1.0, std::pow(d - ramp(r, c), 2) / 4) - 1 +
                                          noise * uniform(random)));
  return cost;
}

TEST(SemiGlobalSearch, FollowsARampBetweenTheIntegers) {
  const auto depth = semi_global_search(cost_of_ramp(20, 20, 40, 0), 20, 20, 40, 0.05, 3);
  for (int r = 1; r < 19; ++r)
    for (int c = 1; c < 19; ++c) EXPECT_NEAR(depth[r * 20 + c], ramp(r, c), 0.3);
}

TEST(SemiGlobalSearch, NoiseThatMisleadsSingleColumnsDoesNotMisleadIt) {
  const auto cost = cost_of_ramp(20, 20, 40, 2);
  const auto depth = semi_global_search(cost, 20, 20, 40, 0.08, 3);
  int alone_wrong = 0, wrong = 0;
  for (int n = 0; n < 400; ++n) {
    const auto first = cost.begin() + n * 40;
    const double alone = static_cast<double>(std::min_element(first, first + 40) - first);
    alone_wrong += std::abs(alone - ramp(n / 20, n % 20)) > 2;
    wrong += std::abs(depth[n] - ramp(n / 20, n % 20)) > 2;
  }
  EXPECT_GT(alone_wrong, 50);
  EXPECT_LT(wrong, 8);  // corners have fewer paths
}

}  // namespace
}  // namespace mammotwin
