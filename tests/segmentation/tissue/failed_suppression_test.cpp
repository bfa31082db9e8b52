#include "segmentation/tissue/failed_suppression.h"

#include <algorithm>

#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

/// A block of fat with its skin at y = 0, and a block of 42 x 30 x 42 mm that is `brightness` times
/// as bright, its front `deep` mm below the skin. Gland has 1.8 of fat.
Volume<std::uint8_t> found(double deep, float brightness = 3) {
  Volume<float> image({60, 60, 60}, Eigen::Vector3d::Constant(2), {0, 0, 0}, 1);
  auto depth = image;
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i) {
        const Eigen::Vector3d x = image.position(i, j, k);
        depth(i, j, k) = static_cast<float>(x.y());
        const Eigen::Vector3d away = (x - Eigen::Vector3d(60, deep + 14, 60)).cwiseAbs();
        const bool in = away.x() <= 20 && away.y() <= 14 && away.z() <= 20;
        if (in) image(i, j, k) = brightness;
      }
  const auto all = image.like<std::uint8_t>(1);
  return failed_suppression(image, all, all, depth, 1.8);
}

SegmentQuality judged(double deep, double sternal_y) {
  SegmentQuality quality;
  judge_suppression(found(deep), sternal_y, quality);
  return quality;
}

TEST(JudgeSuppression, DoubtsBrightFatBelowTheSkin) {
  const SegmentQuality quality = judged(0, 200);
  EXPECT_EQ(quality.status, SegmentStatus::look);
  EXPECT_NEAR(*quality.failed_suppression_ml, 53, 27) << "the block, and some of its blurred rim";
  expect_mentions(quality.reasons.at(0), {"ml of the breast", "look at ("});
  const Eigen::Vector3d place = *quality.doubts.at(0).place_in_lps;
  EXPECT_LT((place - Eigen::Vector3d(60, 14, 60)).norm(), 5);
}

TEST(FailedSuppression, HoldsTheBrightFatAndLittleElse) {
  const Volume<std::uint8_t> where = found(0);
  double inside = 0, outside = 0;
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i) {
        const Eigen::Vector3d away =
            (where.position(i, j, k) - Eigen::Vector3d(60, 14, 60)).cwiseAbs();
        if (away.x() <= 20 && away.y() <= 14 && away.z() <= 20)
          inside += where(i, j, k);
        else if (away.x() > 27 || away.y() > 21 || away.z() > 27)
          outside += where(i, j, k);
      }
  EXPECT_GT(inside / (21 * 15 * 21), 0.97);
  EXPECT_EQ(outside, 0) << "7 mm off it";
}

TEST(FailedSuppression, IsNotDenseGlandJustBelowTheSkin) {
  const Volume<std::uint8_t> where = found(2, 2.3F);
  EXPECT_EQ(std::count(where.values.begin(), where.values.end(), 1), 0);
}

TEST(JudgeSuppression, LeavesBrightGlandAndWhatLiesBehindTheBreastbonesSkin) {
  EXPECT_EQ(judged(40, 200).status, SegmentStatus::ok) << "gland or a lesion";
  EXPECT_EQ(judged(0, -1).status, SegmentStatus::ok) << "the flank";
}

}  // namespace
}  // namespace mammotwin
