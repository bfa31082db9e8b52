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

/// Numbers go by first voxels, also where a part's runs meet late (a U, open at the top).
TEST(Components, AreNumberedInOrderOfTheirFirstVoxels) {
  Volume<std::uint8_t> mask({7, 5, 1}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0);
  for (int j = 0; j < 4; ++j) mask(0, j, 0) = mask(4, j, 0) = 1;
  for (int i = 0; i < 5; ++i) mask(i, 4, 0) = 1;  // joins both arms
  mask(2, 1, 0) = mask(6, 0, 0) = 1;              // within the U, and right of its top
  const Components parts = connected_components(mask);
  EXPECT_EQ(parts.ids(0, 0, 0), 1);
  EXPECT_EQ(parts.ids(4, 0, 0), 1);
  EXPECT_EQ(parts.ids(6, 0, 0), 2);
  EXPECT_EQ(parts.ids(2, 1, 0), 3);
  EXPECT_EQ(parts.sizes, (std::vector<std::size_t>{20, 13, 1, 1}));
}

TEST(Components, OfAnEmptyMaskAreNone) {
  Volume<std::uint8_t> mask({4, 3, 2}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0);
  EXPECT_EQ(connected_components(mask).largest(), 0);
  EXPECT_EQ(largest_component(mask).values, mask.values);
}

TEST(Components, SmallPartsGoByTheirVolume) {
  auto blocks = two_blocks();
  const auto kept = without_small_components(blocks, 0.009);  // 27 and 8 voxels of 0.001 ml
  EXPECT_EQ(std::count(kept.values.begin(), kept.values.end(), 1), 27);
  EXPECT_EQ(largest_component(blocks).values, kept.values);
  blocks.spacing *= 2;  // 0.008 ml a voxel: both are larger now
  EXPECT_EQ(without_small_components(blocks, 0.009).values, blocks.values);
}

}  // namespace
}  // namespace mammotwin
