#include "segmentation/chest_wall/wall_patch.h"

#include <gtest/gtest.h>

#include <numbers>

namespace mammotwin {
namespace {

TEST(WallPatch, IsTheLargestOfThePieces) {
  PectoralWall wall;
  wall.angles = 121, wall.rows = 50;
  wall.first_angle = -std::numbers::pi / 2, wall.angle_step = std::numbers::pi / 120;
  wall.z_step = 2;
  wall.radius.assign(121U * 50, 100);
  std::vector<std::size_t> rays{0, 1, 2};  // a small piece in the first row
  for (int row = 30; row < 41; ++row)
    for (int angle = 55; angle < 66; ++angle) rays.push_back(row * 121 + angle);
  const WallPatch patch = largest_patch(wall, rays);
  // 11 x 11 rays of 100 * pi / 120 x 2 mm, the middle one straight ahead in row 35.
  EXPECT_NEAR(patch.area_cm2, 121 * 2 * std::numbers::pi / 1.2 / 100, 1e-9);
  EXPECT_LT((patch.middle_in_lps - Eigen::Vector3d(0, -100, 70)).norm(), 1e-9);
  EXPECT_NEAR(std::numbers::pi * patch.radius_mm() * patch.radius_mm(), 100 * patch.area_cm2, 1e-9);
  EXPECT_EQ(largest_patch(wall, {}).area_cm2, 0);
}

}  // namespace
}  // namespace mammotwin
