#include "segmentation/chest_wall/muscle_slips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

constexpr float fat = 1, muscle = 1.6F;

/// A block of fat with muscle behind y = 0.
struct Chest {
  Volume<float> image{{80, 80, 40}, Eigen::Vector3d::Ones(), {0, -60, 0}, fat};
  Volume<float> gland = image.like<float>(0);
  HalfBreast half{Side::left, image.like<std::uint8_t>(1), image.like<std::uint8_t>(0), {}, {}};

  Chest() {
    half.above_wall = image.like<float>(0);
    for (int k = 0; k < image.size.z(); ++k)
      for (int j = 0; j < image.size.y(); ++j)
        for (int i = 0; i < image.size.x(); ++i) {
          const double before_wall = -image.position(i, j, k).y();
          half.inside(i, j, k) = before_wall > 0;
          half.above_wall(i, j, k) = static_cast<float>(std::max(0.0, before_wall));
          if (before_wall <= 0) image(i, j, k) = muscle;
        }
  }

  /// A cylinder along z, as gland, its middle some way in front of the wall.
  void add_cylinder(double before_wall_mm, double radius_mm, float brightness) {
    for (int k = 0; k < image.size.z(); ++k)
      for (int j = 0; j < image.size.y(); ++j)
        for (int i = 0; i < image.size.x(); ++i) {
          const Eigen::Vector3d x = image.position(i, j, k);
          if (std::hypot(x.x() - 40, x.y() + before_wall_mm) >= radius_mm) continue;
          image(i, j, k) = brightness, gland(i, j, k) = 1;
        }
  }
  std::vector<MuscleSlip> found() const { return find_muscle_slips(half, gland, image); }
};

TEST(MuscleSlips, AreWhatLiesOnTheWallAsBrightAsMuscle) {
  Chest chest;
  chest.add_cylinder(7, 5, muscle);
  const std::vector<MuscleSlip> slips = chest.found();
  ASSERT_EQ(slips.size(), 1U);
  EXPECT_NEAR(slips[0].ml, 2.76, 1e-9) << "69 voxels in each of 40 slices";
  EXPECT_NEAR(slips[0].forward_mm, 10, 1.1);
  EXPECT_LT((slips[0].middle_in_lps - Eigen::Vector3d(40, -7, 19.5)).norm(), 0.5);
}

TEST(MuscleSlips, AreNotGland) {
  Chest far, thin, brighter, deep;
  far.add_cylinder(30, 10, muscle);
  EXPECT_TRUE(far.found().empty()) << "stands off the wall";
  thin.add_cylinder(5, 1.5, muscle);
  EXPECT_TRUE(thin.found().empty()) << "a vessel";
  brighter.add_cylinder(7, 5, 1.5F * muscle);
  EXPECT_TRUE(brighter.found().empty()) << "half as bright again as muscle";
  deep.add_cylinder(20, 19, muscle);
  EXPECT_TRUE(deep.found().empty()) << "most of it stands off the wall";
}

TEST(MuscleSlips, OfTheRegionAreDoubted) {
  const BreastRegion region{Side::left, 0, 80, 0, 40};
  SegmentQuality small, large, doubted, outside;
  judge_muscle_slips({{2, 9, {40, -7, 20}}}, region, small);
  judge_muscle_slips({{30, 9, {40, -7, 20}}}, region, large);
  judge_muscle_slips({{6, 9, {40, -7, 20}}}, region, doubted);
  judge_muscle_slips({{6, 9, {90, -7, 20}}}, region, outside);
  EXPECT_EQ(small.status, SegmentStatus::ok);
  EXPECT_EQ(large.status, SegmentStatus::ok) << "a layer of gland";
  EXPECT_EQ(outside.status, SegmentStatus::ok);
  EXPECT_EQ(doubted.status, SegmentStatus::look);
  expect_mentions(doubted.reasons.at(0), {"6 ml", "9 mm further forward"});
}

}  // namespace
}  // namespace mammotwin
