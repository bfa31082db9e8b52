#include "segmentation/chest_wall/compared_wall.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/segmentation/message.h"
#include "tests/segmentation/phantom.h"

namespace mammotwin {
namespace {

const BreastRegion whole{Side::left, 0, 400, -400, 400};

TEST(ComparedWall, IsTheSameWithFatSuppressedOrNot) {
  constexpr double search_stiffness = 0.08;
  Phantom phantom;
  SegmentQuality quality;
  const BodyStage body = find_body(phantom.image(), {}, quality);
  const PectoralWall found = find_wall(body, {}, Side::left, search_stiffness).found.wall;
  phantom.fat_suppressed = false;
  const ComparedWall compared =
      compared_wall(phantom.image(), found, body, Side::left, search_stiffness);
  judge_compared_wall(found, compared, body.frame, whole, "", quality);
  EXPECT_LT(*quality.chest_wall_unlike_compared, 0.02);
  EXPECT_EQ(quality.status, SegmentStatus::ok);
}

TEST(ComparedWall, NeedsABreastInTheOtherImage) {
  const Volume<float> empty({40, 40, 40}, {2, 2, 2}, {0, 0, 0}, 1);
  EXPECT_THROW(compared_wall(empty, {}, {}, Side::left, 1), std::runtime_error);
}

/// A wall of 20 rows, and the other image's.
struct TwoWalls {
  PectoralWall found;
  ComparedWall compared;

  TwoWalls() {
    found.angles = 121, found.rows = 20;
    found.first_angle = -std::numbers::pi / 2, found.angle_step = std::numbers::pi / 120;
    found.z_step = 2;
    found.radius.assign(121U * 20, 100);
    compared = {found.radius, 0, 100};
  }

  void move_rows(int rows, double by_mm) {
    for (int n = 0; n < 121 * rows; ++n) compared.radius[n] += by_mm;
  }

  SegmentQuality judged(const BreastRegion& region) const {
    BreastFrame frame;
    frame.z_low = 0, frame.z_high = 100;
    SegmentQuality quality;
    judge_compared_wall(found, compared, frame, region, "series 4 of the study", quality);
    return quality;
  }
};

TEST(ComparedWall, MayLieElsewhereInATenth) {
  TwoWalls walls;
  walls.move_rows(2, -8);
  const SegmentQuality quality = walls.judged(whole);
  EXPECT_NEAR(*quality.chest_wall_unlike_compared, 0.1, 1e-12);
  EXPECT_EQ(quality.status, SegmentStatus::ok);
}

TEST(ComparedWall, IsDoubtedWhereItLiesElsewhereInMore) {
  TwoWalls walls;
  walls.move_rows(5, -8);
  const SegmentQuality quality = walls.judged(whole);
  EXPECT_EQ(quality.status, SegmentStatus::look);
  ASSERT_EQ(quality.reasons.size(), 1U);
  expect_mentions(quality.reasons[0], {"25 %", "8 mm deeper", "series 4", "moved in between"});
}

TEST(ComparedWall, CountsForLittleWithin5Mm) {
  TwoWalls walls;
  walls.move_rows(20, 4.9);
  EXPECT_EQ(walls.judged(whole).chest_wall_unlike_compared, 0);
}

TEST(ComparedWall, IsJudgedBehindTheRegionAndWhereTheOtherImageShowsIt) {
  TwoWalls walls;
  walls.move_rows(5, 8);  // from S 0 to S 8
  EXPECT_EQ(walls.judged({Side::left, 500, 600, 0, 100}).chest_wall_unlike_compared, 0);
  EXPECT_EQ(walls.judged({Side::left, 0, 400, 9, 100}).chest_wall_unlike_compared, 0);
  walls.compared.z_low = 9;
  EXPECT_EQ(walls.judged(whole).chest_wall_unlike_compared, 0);
}

}  // namespace
}  // namespace mammotwin
