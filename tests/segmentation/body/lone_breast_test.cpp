#include "segmentation/body/lone_breast.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

/// The outline of two round breasts, tips at x = 80 and -80, on a chest that falls back beyond 130,
/// from `x_low` to `x_high`; voxels of 2 mm.
Volume<std::uint8_t> outline(double x_low, double x_high) {
  const int columns = static_cast<int>(std::lround((x_high - x_low) / 2)) + 1;
  Volume<std::uint8_t> body({columns, 80, 30}, {2, 2, 4}, {x_low, -80, -60}, 0);
  for (int k = 0; k < body.size.z(); ++k)
    for (int i = 0; i < columns; ++i) {
      const Eigen::Vector3d x = body.position(i, 0, k);
      const double off = std::hypot(std::abs(x.x()) - 80, x.z()), flank = std::abs(x.x()) - 130;
      if (flank > 30) continue;
      const double front = flank > 0 ? -flank : off < 50 ? std::sqrt(50 * 50 - off * off) : 0;
      for (int j = 0; j < body.size.y(); ++j) body(i, j, k) = -body.position(i, j, k).y() < front;
    }
  return body;
}

TEST(LoneBreast, IsFoundWithItsSide) {
  const auto left = find_lone_breast(outline(-10, 180)),
             right = find_lone_breast(outline(-180, 10));
  ASSERT_TRUE(left && right);
  EXPECT_EQ(left->side, Side::left);
  EXPECT_EQ(right->side, Side::right);
  EXPECT_NEAR(left->breastbone_x, 10, 12) << "the skin is flat to x = 30";
  EXPECT_NEAR(right->breastbone_x, -left->breastbone_x, 1e-9);
  EXPECT_FALSE(left->is_cut);
}

TEST(LoneBreast, ThatTheImageCutsIsSaid) {
  const auto cut = find_lone_breast(outline(36, 180));
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->side, Side::left);
  EXPECT_TRUE(cut->is_cut);
}

TEST(LoneBreast, IsNoneOnAFlatChest) {
  Volume<std::uint8_t> flat = outline(-10, 180);
  for (int k = 0; k < flat.size.z(); ++k)
    for (int j = 0; j < flat.size.y(); ++j)
      for (int i = 0; i < flat.size.x(); ++i)
        if (flat.position(i, j, k).y() < 0) flat(i, j, k) = 0;
  EXPECT_FALSE(find_lone_breast(flat));
}

TEST(LoneBreast, IsFoundWhereTheOtherIsGone) {
  Volume<std::uint8_t> body = outline(-180, 180);
  for (int k = 0; k < body.size.z(); ++k)
    for (int j = 0; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i) {
        const Eigen::Vector3d x = body.position(i, j, k);
        if (x.x() < 0 && x.y() < 0) body(i, j, k) = 0;
      }
  const auto left = find_lone_breast(body);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->side, Side::left);
  EXPECT_NEAR(left->breastbone_x, 0, 1e-9);
  EXPECT_FALSE(left->is_cut);
}

TEST(LoneBreast, MirrorImageStandsBesideIt) {
  Volume<float> image({6, 1, 1}, {2, 1, 1}, {10, 0, 0}, 0);
  for (int i = 0; i < 6; ++i) image(i, 0, 0) = static_cast<float>(i);
  const Volume<float> left = with_mirror_image(image, {Side::left, 13});
  EXPECT_EQ(left.values, (std::vector<float>{5, 4, 3, 2, 2, 3, 4, 5}));
  EXPECT_EQ(left.position(4, 0, 0).x(), 14) << "what was imaged stays in its place";
  const Volume<float> right = with_mirror_image(image, {Side::right, 17});
  EXPECT_EQ(right.values, (std::vector<float>{0, 1, 2, 3, 3, 2, 1, 0}));
  EXPECT_EQ(right.position(0, 0, 0).x(), 10);
}

}  // namespace
}  // namespace mammotwin
