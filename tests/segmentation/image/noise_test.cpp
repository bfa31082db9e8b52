#include "segmentation/image/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/segmentation/filtered.h"

namespace mammotwin {
namespace {

constexpr double deviation = 5;

Volume<float> image_of(const Eigen::Vector3i& size) {
  return Volume<float>(size, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0);
}

/// Gaussian noise about 0.
Volume<float> white_noise(const Eigen::Vector3i& size, unsigned seed) {
  auto image = image_of(size);
  std::mt19937 random(seed);
  std::normal_distribution<float> gauss(0, deviation);
  for (float& value : image.values) value = gauss(random);
  return image;
}

/// What a scanner shows of air.
Volume<float> magnitude(const Volume<float>& real, const Volume<float>& imaginary) {
  auto out = real;
  for (std::size_t v = 0; v < out.values.size(); ++v)
    out.values[v] = std::hypot(real.values[v], imaginary.values[v]);
  return out;
}

TEST(NoiseOfDetail, IsThatOfTheImageBesideAnEdge) {
  Volume<float> image = white_noise({20, 16, 16}, 5);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 20; ++i) image(i, j, k) += i < 10 ? 100.0F : 200.0F;
  // 8 x 8 x 10 cubes: the median of 640 has a standard deviation of 5 %.
  for (const int step : {1, 2})
    EXPECT_NEAR(noise_of_detail(image, image.like<std::uint8_t>(1), step), deviation,
                3 * 0.05 * deviation);
  EXPECT_EQ(noise_of_detail(image, image.like<std::uint8_t>(0)), 0);
}

TEST(NoiseOfDetail, AtADistanceSeesMoreOfFilteredNoise) {
  const Volume<float> image = filtered(white_noise({40, 40, 40}, 6));
  const double all = deviation * std::pow(0.44, 1.5);
  const auto everywhere = image.like<std::uint8_t>(1);
  // A mixed difference of separable noise has the variance times 1 - correlation for each axis.
  EXPECT_NEAR(noise_of_detail(image, everywhere, 1), all * std::pow(0.20 / 0.44, 1.5), 0.05 * all);
  EXPECT_NEAR(noise_of_detail(image, everywhere, 2), all * std::pow(0.40 / 0.44, 1.5), 0.1 * all);
}

TEST(NoiseCorrelation, TellsFilteredNoiseFromWhiteInTheAirOnly) {
  const Eigen::Vector3i size(48, 48, 48);
  const Volume<float> a = white_noise(size, 7), b = white_noise(size, 8);
  auto body = a.like<std::uint8_t>(0);
  const auto white = noise_correlation(magnitude(a, b), body);
  ASSERT_TRUE(white);
  EXPECT_NEAR(*white, 0, 0.02);
  Volume<float> image = magnitude(filtered(a), filtered(b));
  // A magnitude of no signal has about the square of the correlation of its parts: 0.30.
  EXPECT_NEAR(noise_correlation(image, body).value(), std::pow(0.24 / 0.44, 2), 0.04);

  for (int k = 0; k < 48; ++k)
    for (int j = 0; j < 48; ++j)
      for (int i = 0; i < 16; ++i) body(i, j, k) = 1, image(i, j, k) = 100.0F * (i / 8);
  EXPECT_NEAR(noise_correlation(image, body).value(), std::pow(0.24 / 0.44, 2), 0.04);
}

TEST(NoiseCorrelation, IsNotKnownOfAirThatWasBlanked) {
  const Volume<float> image = image_of({48, 48, 48});
  EXPECT_FALSE(noise_correlation(image, image.like<std::uint8_t>(0)));
  const Volume<float> noisy = magnitude(white_noise({48, 48, 48}, 7), white_noise({48, 48, 48}, 8));
  EXPECT_FALSE(noise_correlation(noisy, noisy.like<std::uint8_t>(1)));
}

}  // namespace
}  // namespace mammotwin
