#include "segmentation/chest_wall/judge_wall.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

/// A wall of muscle in 20 rows, supported everywhere; rays from -90 to 90 degrees.
struct Found {
  BreastFrame frame;
  FoundWall found;

  Found() {
    PectoralWall& wall = found.wall;
    wall.angles = 121, wall.rows = 20;
    wall.first_angle = -std::numbers::pi / 2, wall.angle_step = std::numbers::pi / 120;
    wall.z_step = 2;
    const std::size_t rays = 121U * 20;
    wall.radius.assign(rays, 100);
    wall.cost.assign(rays, -1);
    wall.contrast.assign(rays, {});
    wall.behind.assign(rays, static_cast<float>(wall.contrast.front().muscle));
    frame.z_low = 0, frame.z_high = 100;
    found.searches = {wall, wall, wall};
    found.first = {wall, wall};
  }

  /// Sets one value of all rays in front of the left side in some rows.
  void set_left(std::vector<float>& values, int rows, float value) const {
    for (int row = 0; row < rows; ++row)
      for (int angle = 60; angle < 121; ++angle) values[row * 121 + angle] = value;
  }

  SegmentQuality judged(Side side, double region_low = 0, double region_high = 100) const {
    SegmentQuality quality;
    judge_wall(found, frame, {side, -200, 200, region_low, region_high}, quality);
    return quality;
  }
};

TEST(JudgeWall, BelievesAWallThatTheImageSupports) {
  const SegmentQuality quality = Found().judged(Side::left);
  EXPECT_EQ(quality.chest_wall_doubt, 0);
  EXPECT_EQ(quality.chest_wall_fat_behind, 0);
  EXPECT_EQ(quality.status, SegmentStatus::ok);
}

TEST(JudgeWall, DoubtsTheShareThatTheImageDoesNotSupport) {
  Found found;
  found.set_left(found.found.wall.cost, 1, 0);
  EXPECT_NEAR(*found.judged(Side::left).chest_wall_doubt, 1 / 20.0, 1e-12);
  EXPECT_EQ(found.judged(Side::left).status, SegmentStatus::ok);
  found.set_left(found.found.wall.cost, 4, 0);
  const SegmentQuality quality = found.judged(Side::left);
  EXPECT_NEAR(*quality.chest_wall_doubt, 4 / 20.0, 1e-12);
  EXPECT_EQ(quality.status, SegmentStatus::look);
  ASSERT_EQ(quality.reasons.size(), 1U);
  expect_mentions(quality.reasons[0],
                  {"20 %", "chest wall", "at most 10 %", "draw it", "chest_wall.markups"});
}

TEST(JudgeWall, LooksAtOneSideOnly) {
  Found found;
  found.set_left(found.found.wall.cost, 20, 0);
  EXPECT_EQ(found.judged(Side::left).chest_wall_doubt, 1);
  // The ray at 0 degrees belongs to both sides: one of the 34 to 50 degrees.
  EXPECT_NEAR(*found.judged(Side::right).chest_wall_doubt, 1 / 34.0, 1e-12);
}

TEST(JudgeWall, LooksAtTheSlicesOfTheRegionOnly) {
  Found found;
  found.set_left(found.found.wall.cost, 4, 0);  // from S 0 to S 6
  EXPECT_EQ(found.judged(Side::left, 7).chest_wall_doubt, 0);
}

/// Every search but the first goes 20 mm deeper.
TEST(JudgeWall, SaysAWallThatMovesWhenItIsLookedForOtherwise) {
  Found found;
  for (double& radius : found.found.searches[1].radius) radius -= 20;
  const SegmentQuality quality = found.judged(Side::left);
  EXPECT_EQ(quality.chest_wall_unsteady, 1);
  ASSERT_EQ(quality.reasons.size(), 1U);
  expect_mentions(quality.reasons[0], {"100 %", "moves by 20 mm"});
}

TEST(JudgeWall, BelievesASteadyEdgeBeforeADeeperOne) {
  Found found;
  for (double& radius : found.found.first.other.radius) radius -= 20;
  EXPECT_EQ(found.judged(Side::left).chest_wall_disputed, 1);
  EXPECT_EQ(found.judged(Side::left).status, SegmentStatus::ok);
  for (double& radius : found.found.first.other.radius) radius += 40;
  expect_mentions(found.judged(Side::left).reasons.at(0), {"20 mm further forward"});
}

TEST(JudgeWall, DoubtsAWallWithFatBehindIt) {
  Found found;
  found.set_left(found.found.wall.behind, 3, 1);
  const SegmentQuality quality = found.judged(Side::left);
  EXPECT_NEAR(*quality.chest_wall_fat_behind, 3 / 20.0, 1e-12);
  ASSERT_EQ(quality.reasons.size(), 1U);
  expect_mentions(quality.reasons[0], {"15 %", "fat rather than muscle"});
}

/// Voxels of 2 mm: each on the wall counts for 0.04 cm2 of the 3 that may be.
TEST(JudgeWall, DoubtsAWallUnderALargeLesion) {
  HalfBreast half;
  half.body =
      Volume<std::uint8_t>({200, 2, 1}, Eigen::Vector3d::Constant(2), Eigen::Vector3d::Zero(), 1);
  half.above_wall = half.body.like<float>(2);
  for (int i = 0; i < 200; ++i) half.above_wall(i, 1, 0) = 4;  // farther than 1.5 voxels
  const auto judged = [&](int voxels) {
    auto lesions = half.body.like<std::uint8_t>(0);
    for (int i = 0; i < voxels; ++i) lesions(i, 0, 0) = lesions(i, 1, 0) = label::lesion;
    SegmentQuality quality;
    judge_lesions_on_wall(half, lesions, quality);
    return quality;
  };
  EXPECT_EQ(judged(74).status, SegmentStatus::ok);
  EXPECT_EQ(judged(76).status, SegmentStatus::look);
  expect_mentions(judged(100).reasons.at(0), {"4 cm2", "chest wall"});
}

}  // namespace
}  // namespace mammotwin
