#include "segmentation/shading/flank_shading.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

/// Fat from the skin at x = 0 to 15 mm, muscle of 0.4 below it; all three times darker from
/// y = 30 mm on.
struct Flank {
  Volume<float> image{{40, 60, 20}, Eigen::Vector3d::Constant(2), Eigen::Vector3d::Zero(), 0};
  Volume<float> depth = image;
  BreastFrame frame;

  Flank() {
    frame.sternal_y = 0;
    for (int k = 0; k < 20; ++k)
      for (int j = 0; j < 60; ++j)
        for (int i = 0; i < 40; ++i) {
          depth(i, j, k) = 2.0F * i + 1;
          image(i, j, k) = (depth(i, j, k) < 15 ? 1.0F : 0.4F) / (j >= 15 ? 3.0F : 1.0F);
        }
  }
};

TEST(FlankShading, IsThatOfTheFatUnderTheSkin) {
  const Flank flank;
  const Volume<float> shading = flank_shading(flank.image, flank.depth, flank.frame);
  for (const int i : {1, 5, 12}) {  // muscle, too, which lies behind that fat
    EXPECT_FLOAT_EQ(shading(i, 8, 10), 1) << i;
    EXPECT_NEAR(shading(i, 50, 10), 1 / 3.0, 0.02) << i;
  }
}

TEST(FlankShading, LeavesFatAloneThatIsBrightEnough) {
  Flank flank;
  for (float& value : flank.image.values) value *= 4;
  const Volume<float> shading = flank_shading(flank.image, flank.depth, flank.frame);
  for (const float value : shading.values) EXPECT_FLOAT_EQ(value, 1);
}

}  // namespace
}  // namespace mammotwin
