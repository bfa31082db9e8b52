#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/validation/other_fits/skin_slab_fits.h"
#include "pipeline/validation/other_fits/stiffness_fits.h"

namespace mammotwin {
namespace {

// What Ceres is judged by must be Ceres at its best: without noise it has to find what was drawn.
TEST(SkinByCeres, FindsTheSkinThatAProfileWasMadeOf) {
  constexpr double voxel_mm = 1.2, noise = 0.01;
  for (const double level : {2.0, 0.45})
    for (const double thickness : {1.5, 3.0}) {
      const DrawnSkin drawn{.thickness = thickness, .surface = 0.2, .blur = 0.6, .level = level};
      const DrawnSkin found = skin_by_ceres(profile_of(drawn, voxel_mm), voxel_mm, noise, false);
      EXPECT_NEAR(found.thickness, thickness, 0.01) << level;
      EXPECT_NEAR(found.surface, 0.2, 0.01) << level;
    }
}

TEST(FactorByCeres, FindsTheLeastSumOfSquares) {
  // Σ (ln f - aᵢ)² is least at the mean of aᵢ.
  const DistancesAtFactor distances = [](double f) {
    return std::vector<double>{std::log(f) - 0.2, std::log(f) - 0.6};
  };
  for (const bool bounded : {false, true}) {
    const FactorByCeres found = factor_by_ceres(distances, bounded);
    ASSERT_TRUE(found.factor);
    EXPECT_NEAR(std::log(*found.factor), 0.4, 0.01);
    EXPECT_GE(found.trials, 3) << "there, a difference, and a step";
  }
}

TEST(FactorByCeres, FindsNoneWhereNothingComesToRestAtOne) {
  const DistancesAtFactor distances = [](double f) {
    return f < 2 ? std::vector<double>{} : std::vector<double>{f - 4};
  };
  EXPECT_FALSE(factor_by_ceres(distances, true).factor);
}

}  // namespace
}  // namespace mammotwin
