#include "segmentation/body/judge_region.h"

#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

FoundRegion found_with(double outside) {
  FoundRegion found;
  found.region = {Side::left, 0, 100, -50, 50};
  found.outside.share = outside;
  found.outside.volume_ml = 100;
  found.outside.middle_in_lps = {12.4, 30, 60};
  return found;
}

SegmentQuality judged(double outside, const Eigen::Vector3d& nipple,
                      const std::vector<Lesion>& lesions = {}) {
  Segmentation s;
  s.nipple_in_lps = nipple;
  s.lesions = lesions;
  const FoundRegion found = found_with(outside);
  s.region = found.region;
  SegmentQuality quality;
  judge_region(found, s, quality);
  return quality;
}

const Eigen::Vector3d inside(50, 0, 0);

TEST(JudgeRegion, SaysHowMuchOfTheBreastIsOutsideAndWhere) {
  EXPECT_EQ(judged(0.02, inside).status, SegmentStatus::ok);
  const SegmentQuality some = judged(0.06, inside);
  EXPECT_EQ(some.status, SegmentStatus::look);
  expect_mentions(some.reasons.front(), {"6 %", "100 ml", "(12, 30, 60) mm LPS", "3 %"});
  EXPECT_EQ(judged(0.41, inside).status, SegmentStatus::refused);
}

TEST(JudgeRegion, RefusesARegionWithoutTheNippleOrALesion) {
  EXPECT_EQ(judged(0, {50, 0, 70}).status, SegmentStatus::refused);
  EXPECT_EQ(judged(0, inside, {{"L1", {20, 0, 0}, 1}}).status, SegmentStatus::ok);
  const SegmentQuality lost = judged(0, inside, {{"L1", {20, 0, 0}, 1}, {"L2", {-7, 0, 0}, 1}});
  EXPECT_EQ(lost.status, SegmentStatus::refused);
  expect_mentions(lost.reasons.front(), {"lesion L2", "(-7, 0, 0) mm LPS"});
}

TEST(JudgeNipple, DoubtsOneThatDoesNotShowOrMayLieElsewhere) {
  const auto judged = [](bool found, double sd) {
    SegmentQuality quality;
    Nipple nipple;
    nipple.is_found = found;
    nipple.sd_mm = sd;
    nipple.rival_in_lps = {30, -10, 40};
    judge_nipple(nipple, quality);
    return quality;
  };
  EXPECT_EQ(judged(true, 3).status, SegmentStatus::ok);
  EXPECT_EQ(judged(false, 25).status, SegmentStatus::look);
  const SegmentQuality unsure = judged(true, 12);
  EXPECT_EQ(unsure.status, SegmentStatus::look);
  expect_mentions(unsure.reasons.front(), {"12 mm", "(30, -10, 40) mm LPS", "look at (0, 0, 0)"});
  ASSERT_EQ(unsure.doubts.size(), 1U);
  EXPECT_EQ(unsure.doubts[0].what, "nipple");
}

}  // namespace
}  // namespace mammotwin
