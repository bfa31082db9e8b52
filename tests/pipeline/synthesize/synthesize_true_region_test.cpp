#include <gtest/gtest.h>

#include "pipeline/synthesize/true_region.h"
#include "pipeline/synthesize/view_extent.h"

namespace mammotwin {
namespace {

/// Two boxes of fat, 40 mm deep, on a wall with 8 mm of fat in front of it, 2 mm voxels. The
/// left one spans x in (20, 60), z in (-30, 30).
Volume<std::uint8_t> two_boxes() {
  Volume<std::uint8_t> labels({101, 41, 81}, Eigen::Vector3d::Constant(2), {-100, -60, -80});
  for (int k = 0; k < 81; ++k)
    for (int j = 0; j < 41; ++j)
      for (int i = 0; i < 101; ++i) {
        const Eigen::Vector3d x = labels.position(i, j, k);
        const bool box = std::abs(std::abs(x.x()) - 40) < 20 && std::abs(x.z()) < 30;
        if (x.y() > 0)
          labels(i, j, k) = label::muscle;
        else if (x.y() > -8 || (box && x.y() > -50))
          labels(i, j, k) = label::fat;
      }
  return labels;
}

TEST(TrueRegion, EndsAtTheValleyAndFifteenMillimetresBeyondTheBreast) {
  const BreastRegion r = true_region(columns_of(two_boxes()), Side::left, {});
  // 0.35 of 50 mm lies between the 8 mm beside the box and the box. The outermost columns of
  // the box stand at x = 58, z = +-28; planes 15 mm beyond them.
  EXPECT_NEAR(r.x_min, 0, 2);
  EXPECT_DOUBLE_EQ(r.x_max, 73);
  EXPECT_DOUBLE_EQ(r.z_min, -43);
  EXPECT_DOUBLE_EQ(r.z_max, 43);
}

TEST(TrueRegion, HoldsEveryLesion) {
  const BreastRegion r = true_region(columns_of(two_boxes()), Side::left, {{80, -5, 50}});
  EXPECT_DOUBLE_EQ(r.x_max, 80);
  EXPECT_DOUBLE_EQ(r.z_max, 50);
}

TEST(TrueRegion, IsPulledInWhereTissueIsThin) {
  Volume<std::uint8_t> labels = two_boxes();
  for (int k = 0; k < 81; ++k)
    for (int j = 0; j < 41; ++j)
      for (int i = 0; i < 101; ++i)  // beyond x = 66 only 2 mm of fat are left
        if (labels.position(i, j, k).x() > 66 && labels.position(i, j, k).y() > -6)
          labels(i, j, k) = label::muscle;
  const BreastRegion r = true_region(columns_of(labels), Side::left, {});
  EXPECT_LE(r.x_max, 67);
  EXPECT_GE(r.x_max, 60);
}

TEST(ViewExtent, IsTheBreastsExtentAlongTheBeam) {
  const Volume<std::uint8_t> labels = two_boxes();
  const BreastRegion r = true_region(columns_of(labels), Side::left, {});
  EXPECT_DOUBLE_EQ(extent_along_beam(labels, r, 0), 56);    // z from -28 to 28
  EXPECT_NEAR(extent_along_beam(labels, r, 90), 36, 1e-9);  // x from 22 to 58
}

}  // namespace
}  // namespace mammotwin
