#include "segmentation/shading/correct_shading.h"

#include <gtest/gtest.h>

#include <cmath>

#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

/// A block of fat with balls of gland, darker towards one side by exp(-0.5), in front of the
/// breastbone: no flank.
struct Block {
  HalfImages images;
  HalfBreast half;
  BreastFrame frame;

  explicit Block(double extent_mm) {
    const int n = static_cast<int>(extent_mm / 2);
    const Volume<float> grid({n, n, n}, Eigen::Vector3d::Constant(2), Eigen::Vector3d::Zero(), 0);
    images.noisy = images.noise = images.pre = images.enhancement = grid;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const float bias = static_cast<float>(std::exp(-0.5 * i / n));
          images.noisy(i, j, k) = (is_gland(i, j, k) ? 1.8F : 1.0F) * bias;
          images.noise(i, j, k) = 0.05F * bias;
          images.pre(i, j, k) = 0.5F * images.noisy(i, j, k);
          images.enhancement(i, j, k) = 1;
        }
    images.denoised = images.noisy;
    half.body = half.inside = grid.like<std::uint8_t>(1);
    half.depth = half.above_wall = grid.like<float>(10);
    frame.sternal_y = 1000;
  }

  static bool is_gland(int i, int j, int k) { return (i / 10 + j / 10 + k / 10) % 4 == 0; }

  /// Standard deviation of the logarithm of fat.
  double unevenness(const Volume<float>& image) const {
    double sum = 0, squares = 0, count = 0;
    for (int k = 0; k < image.size.z(); ++k)
      for (int j = 0; j < image.size.y(); ++j)
        for (int i = 0; i < image.size.x(); ++i) {
          if (is_gland(i, j, k)) continue;
          const double log = std::log(image(i, j, k));
          sum += log, squares += log * log, ++count;
        }
    return std::sqrt(squares / count - sum / count * (sum / count));
  }
};

TEST(CorrectShading, EvensOutTheBreast) {
  const Block block(120);
  EXPECT_NEAR(block.unevenness(block.images.denoised), 0.5 / std::sqrt(12), 0.005);
  const HalfImages even = correct_shading(block.images, block.half, block.frame);
  EXPECT_LT(block.unevenness(even.denoised), 0.04);  // N4: 0.02 to 0.03 on breasts
}

TEST(CorrectShading, IsOneGainForEveryImageButEnhancement) {
  const Block block(120);
  const HalfImages& before = block.images;
  const HalfImages even = correct_shading(before, block.half, block.frame);
  for (std::size_t v = 0; v < before.noisy.values.size(); v += 97) {
    const double gain = even.denoised.values[v] / before.denoised.values[v];
    ASSERT_NEAR(even.noisy.values[v] / before.noisy.values[v], gain, 1e-5);
    ASSERT_NEAR(even.noise.values[v] / before.noise.values[v], gain, 1e-5);
    ASSERT_NEAR(even.pre.values[v] / before.pre.values[v], gain, 1e-5);
  }
  EXPECT_EQ(even.enhancement.values, before.enhancement.values);
}

TEST(CorrectShading, LeavesABreastAloneThatIsTooSmallForN4) {
  const Block block(20);  // 5 blocks of 4 mm each way, of the 200 that N4 is given at least
  const HalfImages even = correct_shading(block.images, block.half, block.frame);
  EXPECT_EQ(even.denoised.values, block.images.denoised.values);
}

TEST(CorrectShading, WideCorrectionSetsTheMedianToOne) {
  const Volume<float> grid({20, 20, 20}, Eigen::Vector3d::Constant(2), Eigen::Vector3d::Zero(), 0);
  Volume<float> image = grid, log_bias = grid;
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 20; ++i) {
        log_bias(i, j, k) = 0.02F * static_cast<float>(i);
        image(i, j, k) = 3 * std::exp(log_bias(i, j, k)) * (k < 5 ? 2.5F : 1.0F);
      }
  const Volume<float> wide = widely_corrected(image, log_bias, grid.like<std::uint8_t>(1));
  EXPECT_NEAR(wide(3, 4, 10), 1, 1e-5);
  EXPECT_NEAR(wide(17, 4, 2), 2.5, 1e-5);  // what is local stays
}

}  // namespace
}  // namespace mammotwin
