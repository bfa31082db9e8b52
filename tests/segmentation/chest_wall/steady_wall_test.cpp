#include "segmentation/chest_wall/steady_wall.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

constexpr int row_rays = 60, all_rays = 600;

/// Ten rows, 2 mm apart, of 60 rays from -88.5 to 88.5 degrees.
PectoralWall even_wall(double radius) {
  constexpr double degree = 0.017453292519943295;
  PectoralWall wall;
  wall.angles = row_rays, wall.rows = all_rays / row_rays;
  wall.first_angle = -88.5 * degree, wall.angle_step = 3 * degree;
  wall.z_step = 2;
  wall.radius.assign(all_rays, radius);
  wall.cost.assign(all_rays, static_cast<float>(-radius));  // tells whose it is
  wall.behind.assign(all_rays, 1.5F);
  wall.contrast.assign(all_rays, {1, 1.5});
  return wall;
}

/// Another radius on the patient's left.
PectoralWall wall_with_left(double radius, double on_the_left) {
  PectoralWall wall = even_wall(radius);
  for (int n = 0; n < all_rays; ++n)
    if (n % row_rays >= row_rays / 2) wall.radius[n] = on_the_left;
  return wall;
}

TEST(MiddleWall, IsTheOneThatTwoOfThreeAgreeOn) {
  const PectoralWall middle =
      middle_wall({wall_with_left(100, 80), even_wall(101), wall_with_left(99, 100)});
  for (int n = 0; n < all_rays; ++n) EXPECT_EQ(middle.radius[n], 100) << n;
}

TEST(MiddleWall, TakesCostWithTheRadius) {
  const PectoralWall middle = middle_wall({even_wall(80), even_wall(101), even_wall(100)});
  EXPECT_EQ(middle.cost.front(), -100);
}

TEST(WallFlips, AreTheShareOfTheSideThatMoved) {
  const std::vector<PectoralWall> walls{even_wall(100), wall_with_left(102, 80), even_wall(98)};
  const PectoralWall middle = middle_wall(walls);
  const WallFlips left = wall_flips(walls, middle, Side::left, 0, 18);
  EXPECT_EQ(left.share, 1);
  EXPECT_EQ(left.median_mm, 20) << "from 100 to 80";
  EXPECT_GT(left.patch.middle_in_lps.x(), 0);
  EXPECT_EQ(wall_flips(walls, middle, Side::right, 0, 18).share, 0) << "98 to 102 is less than 5";
}

}  // namespace
}  // namespace mammotwin
