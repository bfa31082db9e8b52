#include "segmentation/image/components.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

Volume<std::uint8_t> two_blocks() {
  Volume<std::uint8_t> mask({10, 10, 10}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) mask(i, j, k) = 1;              // 27 voxels
  for (int k = 3; k < 7; ++k) mask(3, 3, k) = mask(4, 3, k) = 1;  // 8, touching at an edge only
  return mask;
}

TEST(Components, TouchingAtAnEdgeIsNotConnected) {
  const Components parts = connected_components(two_blocks());
  ASSERT_EQ(parts.sizes.size(), 3U);
  EXPECT_EQ(parts.sizes[0], 1000U - 35);
  EXPECT_EQ(parts.sizes[1], 27U);
  EXPECT_EQ(parts.sizes[2], 8U);
  EXPECT_EQ(parts.largest(), 1);
}

TEST(Components, SmallPartsGo) {
  const auto kept = without_small_components(two_blocks(), 9);
  EXPECT_EQ(std::count(kept.values.begin(), kept.values.end(), 1), 27);
  EXPECT_EQ(largest_component(two_blocks()).values, kept.values);
}

}  // namespace
}  // namespace mammotwin
