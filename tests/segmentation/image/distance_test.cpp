#include "segmentation/image/distance.h"

#include <gtest/gtest.h>

#include <random>

namespace mammotwin {
namespace {

Volume<std::uint8_t> random_mask(double share) {
  Volume<std::uint8_t> mask({12, 9, 7}, {1.0, 0.7, 2.3}, Eigen::Vector3d::Zero(), 0);
  std::mt19937 random(7);
  for (auto& value : mask.values) value = random() < share * 4294967296.0;
  return mask;
}

TEST(Distance, EqualsTheSmallestOverAllVoxels) {
  const auto mask = random_mask(0.02);
  const auto d = distance_to(mask);
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 12; ++i) {
        double smallest = 1e9;
        for (int c = 0; c < 7; ++c)
          for (int b = 0; b < 9; ++b)
            for (int a = 0; a < 12; ++a)
              if (mask(a, b, c))
                smallest =
                    std::min(smallest, (mask.position(a, b, c) - mask.position(i, j, k)).norm());
        EXPECT_NEAR(d(i, j, k), smallest, 1e-5);  // floats near 10
      }
}

TEST(Distance, OfAnEmptyMaskIsLarge) { EXPECT_GT(distance_to(random_mask(0))(3, 3, 3), 1e5); }

TEST(Distance, OpeningDropsWhatIsThinAndClosingFillsGaps) {
  Volume<std::uint8_t> mask({30, 30, 30}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0);
  for (int k = 5; k < 25; ++k)
    for (int j = 5; j < 25; ++j)
      for (int i = 5; i < 25; ++i) mask(i, j, k) = 1;
  mask(15, 15, 3) = mask(15, 15, 4) = 1;             // a hair
  for (int k = 5; k < 25; ++k) mask(12, 12, k) = 0;  // a crack
  EXPECT_FALSE(opened(mask, 2)(15, 15, 3));
  EXPECT_TRUE(opened(mask, 2)(20, 20, 20));
  EXPECT_TRUE(closed(mask, 2)(12, 12, 15));
  EXPECT_FALSE(closed(mask, 2)(2, 2, 2));
}

}  // namespace
}  // namespace mammotwin
