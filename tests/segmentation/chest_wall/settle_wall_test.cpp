#include "segmentation/chest_wall/settle_wall.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

/// Ten rows of 60 rays from -88.5 to 88.5 degrees, supported all over.
PectoralWall wall_at(double radius) {
  constexpr double degree = 0.017453292519943295;
  PectoralWall wall;
  wall.angles = 60, wall.rows = 10;
  wall.first_angle = -88.5 * degree, wall.angle_step = 3 * degree;
  wall.z_step = 2;
  wall.radius.assign(600, radius);
  wall.cost.assign(600, -2);
  wall.behind.assign(600, 1.5F);
  wall.contrast.assign(600, {1, 1.5});
  return wall;
}

TEST(SettledWall, IsThatWithThePriorWhereTheImageSupportsBoth) {
  const SettledWall settled = settled_wall(wall_at(85), wall_at(105), 0, 18);
  EXPECT_EQ(settled.wall.radius, wall_at(105).radius);
  EXPECT_TRUE(settled.left_by_prior);
  const WallDispute dispute = wall_dispute(settled.wall, settled.other, Side::left, 0, 18);
  EXPECT_EQ(dispute.share, 1);
  EXPECT_EQ(dispute.median_mm, -20) << "the image's edge lies deeper";
}

TEST(SettledWall, IsTheImagesOnASideWhereThePriorFindsNoEdge) {
  PectoralWall unsupported = wall_at(105);
  for (int n = 0; n < 600; ++n)
    if (n % 60 < 30) unsupported.cost[n] = 0;  // the patient's right
  const SettledWall settled = settled_wall(wall_at(85), unsupported, 0, 18);
  EXPECT_TRUE(settled.left_by_prior);
  EXPECT_FALSE(settled.right_by_prior);
  EXPECT_EQ(wall_dispute(settled.wall, settled.other, Side::right, 0, 18).median_mm, 20)
      << "the usual wall lies further forward";
  for (int n = 0; n < 600; ++n) EXPECT_EQ(settled.wall.radius[n], n % 60 < 30 ? 85 : 105);
}

// Thin muscle before a lung that is as dark as suppressed fat, and the edge of a heart behind it.
TEST(SettledWall, IsNotAnEdgeOfOrgansWhereALungLiesBehindTheMuscle) {
  PectoralWall before_lung = wall_at(105);
  for (int n = 0; n < 600; ++n)
    if (n % 3 == 0) before_lung.behind[n] = 1;
  EXPECT_TRUE(settled_wall(wall_at(85), before_lung, 0, 18).left_by_prior);
  EXPECT_FALSE(settled_wall(wall_at(95), before_lung, 0, 18).left_by_prior)
      << "10 mm deeper, a chest may be";
}

TEST(SettledWall, IsNotDisputedByLessThanFiveMm) {
  const SettledWall settled = settled_wall(wall_at(100), wall_at(104), 0, 18);
  EXPECT_EQ(wall_dispute(settled.wall, settled.other, Side::left, 0, 18).share, 0);
  EXPECT_EQ(settled.wall.radius, wall_at(100).radius) << "the image's";
}

}  // namespace
}  // namespace mammotwin
