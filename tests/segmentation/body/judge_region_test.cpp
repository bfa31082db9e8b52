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

TEST(JudgeNipple, DoubtsOneThatDoesNotStandOutOrHasARival) {
  const auto status = [](double stands_out, double rival, const Eigen::Vector3d& rival_at) {
    SegmentQuality quality;
    Nipple nipple;
    nipple.stands_out_mm = stands_out;
    nipple.rival_share = rival;
    nipple.rival_in_lps = rival_at;
    judge_nipple(nipple, quality);
    return quality.status;
  };
  EXPECT_EQ(status(0, 0, Eigen::Vector3d::Zero()), SegmentStatus::look);
  EXPECT_EQ(status(4, 0.3, {0, 0, 40}), SegmentStatus::ok);
  EXPECT_EQ(status(4, 0.8, {0, 0, 40}), SegmentStatus::look);
  EXPECT_EQ(status(4, 0.8, {0, 0, 8}), SegmentStatus::ok) << "the same nipple";
}

}  // namespace
}  // namespace mammotwin
