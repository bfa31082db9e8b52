#include "segmentation/image/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

Volume<float> linear_field() {
  Volume<float> image({20, 18, 16}, {1, 1.5, 2}, {3, -4, 5}, 0);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 18; ++j)
      for (int i = 0; i < 20; ++i) {
        const Eigen::Vector3d x = image.position(i, j, k);
        image(i, j, k) = static_cast<float>(2 * x.x() - x.y() + 0.5 * x.z());
      }
  return image;
}

TEST(Smoothing, LeavesALinearFieldAloneInside) {
  const auto image = linear_field(), smooth = gaussian_smoothed(image, 1.5);
  EXPECT_NEAR(smooth(10, 9, 8), image(10, 9, 8), 1e-3);  // sums of a dozen floats near 50
}

TEST(Smoothing, SpreadsAPointAsAGaussian) {
  Volume<float> image({31, 31, 31}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0);
  image(15, 15, 15) = 1;
  const auto smooth = gaussian_smoothed(image, 2);
  // Ratio over one sigma; the kernel's cut cancels.
  EXPECT_NEAR(smooth(17, 15, 15) / smooth(15, 15, 15), std::exp(-0.5), 1e-5);
}

TEST(Smoothing, WeightedMeanIgnoresWhatHasNoWeight) {
  auto image = linear_field();
  for (float& value : image.values) value = 7;
  auto weight = image.like<float>(1);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 18; ++j)
      for (int i = 10; i < 20; ++i) image(i, j, k) = 1000, weight(i, j, k) = 0;
  EXPECT_NEAR(weighted_smoothed(image, weight, 2)(11, 9, 8), 7, 1e-4);
}

TEST(Smoothing, InterpolationIsExactForALinearField) {
  const Eigen::Vector3d x(9.3, 2.7, 21.1);
  EXPECT_NEAR(interpolated(linear_field(), x), 2 * x.x() - x.y() + 0.5 * x.z(), 1e-4);
}

TEST(Smoothing, BlockMeansCountTheMaskOnly) {
  auto image = linear_field();
  auto mask = image.like<std::uint8_t>(0);
  mask(0, 0, 0) = mask(1, 1, 1) = 1;
  Volume<float> share;
  const auto mean = block_means(image, mask, 3, share);  // 3 x 2 x 2 voxels
  EXPECT_NEAR(mean(0, 0, 0), (image(0, 0, 0) + image(1, 1, 1)) / 2, 1e-5);
  EXPECT_NEAR(share(0, 0, 0), 2.0 / 12, 1e-6);
  EXPECT_TRUE(
      mean.position(0, 0, 0).isApprox((image.position(0, 0, 0) + image.position(2, 1, 1)) / 2));
}

TEST(Smoothing, SmoothFieldFollowsTheMaskedVoxelsAndEndsFarFromThem) {
  Volume<float> image({40, 12, 12}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 7);
  auto mask = image.like<std::uint8_t>(0);
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 10; ++i) image(i, j, k) = 3, mask(i, j, k) = 1;
  const auto field = smooth_field(image, mask, 2, 2);
  EXPECT_EQ(field.size, Eigen::Vector3i(20, 6, 6));
  EXPECT_NEAR(field(0, 3, 3), 3, 1e-5);
  EXPECT_NEAR(field(6, 3, 3), 3, 1e-5) << "what is not in the mask does not count";
  EXPECT_EQ(field(19, 3, 3), 0);
}

TEST(Smoothing, LocalMaximumReachesItsCube) {
  Volume<float> image({9, 9, 9}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0);
  image(4, 4, 4) = 5;
  const auto highest = local_maximum(image, 2);
  EXPECT_EQ(highest(2, 6, 3), 5);
  EXPECT_EQ(highest(1, 4, 4), 0);
}

}  // namespace
}  // namespace mammotwin
