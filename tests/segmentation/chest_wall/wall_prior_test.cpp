#include "segmentation/chest_wall/wall_prior.h"

#include <gtest/gtest.h>

#include <numbers>

namespace mammotwin {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(WallPrior, IsTheSameOnBothSidesAndUnknownBeyondSixtyDegrees) {
  EXPECT_DOUBLE_EQ(usual_radius(30 * degree, 0).mean, 108.7) << "the table's";
  EXPECT_DOUBLE_EQ(usual_radius(-25 * degree, -33).mean, usual_radius(25 * degree, -33).mean);
  EXPECT_EQ(usual_radius(61 * degree, 0).spread, 0);
  EXPECT_EQ(usual_radius(61 * degree, 0).deviation(20), 0);
  EXPECT_DOUBLE_EQ(usual_radius(0.2, 150).mean, usual_radius(0.2, 100).mean);
}

TEST(WallPrior, IsUnsureOfTheBreastbone) {
  EXPECT_GT(usual_radius(0, 0).spread, 1.5 * usual_radius(20 * degree, 0).spread);
}

TEST(WallPrior, CostsHalfTheSquaredDeviationUpToThree) {
  const UsualRadius usual{100, 10};
  std::vector<float> costs(PolarRays::depths, 1);
  add_prior({usual}, costs);
  const auto at = [&](double radius) {
    return costs[static_cast<std::size_t>(radius - PolarRays::least_radius_mm)];
  };
  EXPECT_FLOAT_EQ(at(100), 1);
  EXPECT_FLOAT_EQ(at(90), 1.5);
  EXPECT_FLOAT_EQ(at(120), 3);
  EXPECT_FLOAT_EQ(at(40), 4);
}

}  // namespace
}  // namespace mammotwin
