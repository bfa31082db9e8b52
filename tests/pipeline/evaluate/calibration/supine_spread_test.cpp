#include "pipeline/evaluate/calibration/supine_spread.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

class SupineSpread : public ScratchFolder {
 protected:
  /// Two women: one landmark 100 mm behind the left nipple goes 20 mm medially against it, one 50
  /// mm above the right one 5 mm down; one has no nipple.
  std::vector<WomensLandmark> landmarks() const {
    write("points.csv",
          "woman,point,side,prone_l_mm,prone_p_mm,prone_s_mm,supine_l_mm,supine_p_mm,supine_s_mm,"
          "prone_to_ribs_mm,supine_to_ribs_mm\n"
          "1,nipple,left,60,-100,0,90,-40,0,,\n"
          "1,landmark1,left,60,0,0,70,60,0,30,20\n"
          "2,nipple,right,-60,-100,0,-90,-40,0,,\n"
          "2,landmark1,right,-60,-100,50,-90,-40,45,30,20\n"
          "3,landmark1,left,0,0,0,9,9,9,30,20\n");
    return read_womens_landmarks(folder_ / "points.csv");
  }
};

TEST_F(SupineSpread, LandmarksAreSeenFromTheirOwnNipple) {
  const auto all = landmarks();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].prone, Eigen::Vector3d(0, 100, 0));
  EXPECT_EQ(all[0].supine, Eigen::Vector3d(-20, 100, 0));
  EXPECT_EQ(all[1].supine, Eigen::Vector3d(0, 0, 45));
}

TEST_F(SupineSpread, IsOverTheDistanceAndHoldsWhatItIsWideEnoughFor) {
  const auto all = landmarks();
  const Eigen::Vector3d spread = supine_spread(all);
  EXPECT_NEAR(spread.x(), 0.2 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(spread.y(), 0, 1e-12);
  EXPECT_NEAR(spread.z(), 0.1 / std::sqrt(2), 1e-12);
  const Eigen::Vector3d wide(0.1, 0.1, 0.1);
  EXPECT_EQ(share_held(all, wide, 0.9), 0);
  EXPECT_EQ(share_held(all, wide, 1.1), 0.5);
  EXPECT_EQ(share_held(all, wide, 2.1), 1);
}

}  // namespace
}  // namespace mammotwin
