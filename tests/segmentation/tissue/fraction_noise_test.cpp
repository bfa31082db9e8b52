#include "segmentation/tissue/fraction_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mammotwin {
namespace {

using Mask = Volume<std::uint8_t>;

/// Fat with noise that grows from 0.05 to 0.25 along i; voxels of 1.5 mm.
Volume<float> noisy_fat() {
  Volume<float> fraction({60, 40, 40}, Eigen::Vector3d::Constant(1.5), Eigen::Vector3d::Zero(), 0);
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (std::size_t v = 0; v < fraction.values.size(); ++v)
    fraction.values[v] = (0.05F + 0.2F * static_cast<float>(v % 60) / 60) * normal(random);
  return fraction;
}

double sum_of(const Volume<float>& fraction) {
  double sum = 0;
  for (const float f : fraction.values) sum += f;
  return sum;
}

Volume<float> cleaned(const Volume<float>& fraction) {
  const Mask all = fraction.like<std::uint8_t>(1);
  return without_noise(fraction, all, all);
}

TEST(FractionNoise, OfFatLeavesNextToNoGland) {
  const Volume<float> raw = noisy_fat(), clean = cleaned(raw);
  double cut = 0;
  for (const float f : raw.values) cut += std::max(0.0F, f);
  EXPECT_GT(cut, 0.05 * static_cast<double>(raw.values.size()));
  EXPECT_LT(sum_of(clean), 0.4 * cut);
  for (const float f : clean.values) EXPECT_LT(f, 0.6F);
}

TEST(FractionNoise, OfASpeckIsTakenOutAndAsLargeABrightOneKept) {
  Volume<float> fraction = noisy_fat();
  const auto fill = [&](int i, float value) {
    for (int n = 0; n < 2; ++n) fraction(i + n, 20, 20) = value;
  };
  fill(50, 0.7F);  // noise of 0.22
  fill(5, 0.7F);   // of 0.07
  const Volume<float> clean = cleaned(fraction);
  EXPECT_LT(clean(50, 20, 20), 0.1F);
  EXPECT_GT(clean(5, 20, 20), 0.6F);
}

TEST(FractionNoise, LeavesGlandAndItsHalves) {
  Volume<float> fraction = noisy_fat();
  for (int k = 10; k < 30; ++k)
    for (int j = 10; j < 30; ++j)
      for (int i = 5; i < 25; ++i) fraction(i, j, k) += i == 5 ? 0.5F : 1;
  const Volume<float> clean = cleaned(fraction);
  double inside = 0, rim = 0;
  for (int k = 10; k < 30; ++k)
    for (int j = 10; j < 30; ++j) {
      rim += clean(5, j, k) / 400;
      for (int i = 6; i < 25; ++i) inside += clean(i, j, k) / (400 * 19);
    }
  EXPECT_GT(inside, 0.97);
  EXPECT_NEAR(rim, 0.5, 0.03);
}

TEST(FractionNoise, IsZeroOutside) {
  const Volume<float> raw = noisy_fat();
  Mask interior = raw.like<std::uint8_t>(1);
  interior.values[7] = 0;
  Volume<float> bright = raw;
  bright.values[7] = 1;
  EXPECT_EQ(without_noise(bright, interior, interior).values[7], 0);
}

}  // namespace
}  // namespace mammotwin
