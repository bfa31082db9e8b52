#include "segmentation/body/contrast.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

/// Layers below a flat front, at y = 0: skin to 2.25 mm, fat to 10 mm, and what lies behind.
struct Layers {
  Volume<float> image{{40, 120, 40}, {2, 0.5, 2}, Eigen::Vector3d::Zero(), 0};
  Volume<float> depth = image;
  Volume<std::uint8_t> body = image.like<std::uint8_t>(1);
  BreastFrame frame;

  Layers(float skin, float behind) {
    frame.sternal_y = 60;
    frame.z_low = 0, frame.z_high = 100;
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 120; ++j)
        for (int i = 0; i < 40; ++i) {
          const double d = depth(i, j, k) = static_cast<float>(0.25 + 0.5 * j);
          image(i, j, k) = 100 * (d < 2.25 ? skin : d < 10 ? 1.0F : behind);
        }
  }
};

TEST(Contrast, IsThatOfTheSkinOverTheFatUnderIt) {
  const Layers suppressed(1.6F, 1), other(0.6F, 1);
  const Contrast a = find_contrast(suppressed.image, suppressed.depth, suppressed.frame);
  EXPECT_NEAR(a.skin_over_fat, 1.6, 1e-5);
  EXPECT_TRUE(a.fat_suppressed);
  const Contrast b = find_contrast(other.image, other.depth, other.frame);
  EXPECT_NEAR(b.skin_over_fat, 0.6, 1e-5);
  EXPECT_FALSE(b.fat_suppressed);
}

TEST(Contrast, SkinAcrossThickVoxelsIsLeftOut) {
  Layers layers(1.6F, 1);
  const auto any = [](const Volume<float>& depth) {
    return std::any_of(depth.values.begin(), depth.values.end(), [](float d) { return d > 0; });
  };
  EXPECT_TRUE(any(depth_where_thin(layers.depth, 1.8))) << "it faces along y, 0.5 mm";
  layers.depth.spacing.y() = 2;
  EXPECT_FALSE(any(depth_where_thin(layers.depth, 1.8)));
}

TEST(Contrast, FatIsOutshoneByMuscleOnlyWhereItIsSuppressed) {
  const Layers suppressed(1, 1.6F), other(1, 0.45F);
  EXPECT_TRUE(
      is_fat_outshone(suppressed.image, suppressed.body, suppressed.depth, suppressed.frame));
  EXPECT_FALSE(is_fat_outshone(other.image, other.body, other.depth, other.frame));
}

/// In the 5 to 8.5 mm below the skin 20 % are gland. It is brighter than suppressed fat, whose 30th
/// percentile is asked, and darker than other fat, whose 70th is: fat's own value both times.
TEST(Contrast, FatUnderTheSkinIsReadOnTheSideWhereGlandIsNot) {
  Layers layers(1, 1);
  for (const float gland : {1.8F, 0.45F}) {
    Volume<float> image = layers.image;
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 120; ++j)
        for (int i = 0; i < 40; i += 5) image(i, j, k) *= gland;
    EXPECT_FLOAT_EQ(subcutaneous_fat(image, layers.depth, layers.frame, gland > 1), 100);
  }
}

TEST(Contrast, WithoutFatUnderTheSkinThereIsNoBreast) {
  Layers layers(1, 1);
  layers.frame.z_low = 500, layers.frame.z_high = 600;
  expect_mentions(
      message_of([&] { subcutaneous_fat(layers.image, layers.depth, layers.frame, true); }),
      {"no breast found", "expected"});
}

}  // namespace
}  // namespace mammotwin
