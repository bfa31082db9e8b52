#include "segmentation/image/em_bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mammotwin {
namespace {

/// Two tissues in blobs of 20 mm, 1 and `bright`, times exp(0.4 x / 200 mm), with 3 % of noise, on
/// blocks of 4 mm.
struct TwoTissues {
  static constexpr double slope = 0.4 / 200;  ///< of the logarithm [per mm]
  Volume<float> image{{50, 30, 30}, Eigen::Vector3d::Constant(4), Eigen::Vector3d::Zero(), 0};
  Volume<std::uint8_t> all = image.like<std::uint8_t>(1);
  double share_bright = 0;

  explicit TwoTissues(double bright) {
    std::mt19937 random(4);
    std::normal_distribution<double> noise(0, 0.03);
    for (int k = 0; k < 30; ++k)
      for (int j = 0; j < 30; ++j)
        for (int i = 0; i < 50; ++i) {
          const bool is_bright = (i / 5 + j / 5 + k / 5) % 2;
          share_bright += is_bright / 45000.0;
          const double tissue = is_bright ? bright : 1;
          image(i, j, k) = static_cast<float>(
              tissue * std::exp(slope * image.position(i, j, k).x()) + noise(random));
        }
  }

  /// Root mean square of what is left of the bias, whatever its mean.
  double left_over(const Volume<float>& log_bias) const {
    double sum = 0, squares = 0, count = 0;
    for (int k = 0; k < 30; ++k)
      for (int j = 0; j < 30; ++j)
        for (int i = 0; i < 50; ++i) {
          const double left = log_bias(i, j, k) - slope * image.position(i, j, k).x();
          sum += left, squares += left * left, ++count;
        }
    return std::sqrt(squares / count - sum / count * (sum / count));
  }
};

TEST(EmBias, FindsTheSlopeUnderTwoTissuesAndTheirBrightness) {
  const TwoTissues tissues(1.8);
  const BiasEstimate bias = estimate_bias(tissues.image, tissues.all, 2);
  // The slope is 0.4 from end to end, 0.115 in the root mean square. A Gaussian mean follows it
  // but at the ends, where it lacks 0.8 of its width of 25 mm: 0.04.
  EXPECT_NEAR(tissues.left_over(bias.log_bias.like<float>(0)), 0.115, 0.005);
  EXPECT_LT(tissues.left_over(bias.log_bias), 0.03);
  ASSERT_EQ(bias.classes.size(), 2U);
  EXPECT_NEAR(bias.classes[1].mean - bias.classes[0].mean, std::log(1.8), 0.03);
  EXPECT_NEAR(bias.classes[1].weight, tissues.share_bright, 0.03);
}

TEST(EmBias, CorrectsByWhatItFound) {
  const TwoTissues tissues(1.8);
  const BiasEstimate bias = estimate_bias(tissues.image, tissues.all, 2);
  const Eigen::Vector3d x = bias.log_bias.position(20, 10, 12);
  EXPECT_NEAR(bias.correction(x), std::exp(-bias.log_bias(20, 10, 12)), 1e-6);
}

/// Of one class the field is the Gaussian mean of the logarithm: a bump 15 mm wide keeps
/// (15^2 / (15^2 + s^2))^1.5 of its height, 0.136 at s = 25 mm and 0.014 at 60 mm.
TEST(EmBias, TheWideFieldKeepsWhatIsLocalInTheImage) {
  constexpr double height = 0.4, width_mm = 15;
  Volume<float> image({61, 61, 61}, Eigen::Vector3d::Constant(4), Eigen::Vector3d::Zero(), 0);
  const Eigen::Vector3d middle = image.position(30, 30, 30);
  for (int k = 0; k < 61; ++k)
    for (int j = 0; j < 61; ++j)
      for (int i = 0; i < 61; ++i) {
        const double d = (image.position(i, j, k) - middle).norm() / width_mm;
        image(i, j, k) = static_cast<float>(std::exp(height * std::exp(-d * d / 2)));
      }
  const BiasEstimate bias = estimate_bias(image, image.like<std::uint8_t>(1), 1);
  // Over a corner that the bump does not reach; kernels are cut at 3 widths (0.3 %), and what the
  // class takes for its mean moves both.
  EXPECT_NEAR(bias.log_bias(30, 30, 30) - bias.log_bias(0, 0, 0), 0.136 * height, 0.004);
  EXPECT_NEAR(bias.wide_log_bias(30, 30, 30) - bias.wide_log_bias(0, 0, 0), 0.014 * height, 0.004);
}

TEST(EmBias, OfAnEmptyMaskIsNone) {
  const TwoTissues tissues(1.8);
  const BiasEstimate bias = estimate_bias(tissues.image, tissues.all.like<std::uint8_t>(0), 2);
  EXPECT_TRUE(bias.classes.empty());
  for (const float value : bias.log_bias.values) ASSERT_EQ(value, 0);
}

}  // namespace
}  // namespace mammotwin
