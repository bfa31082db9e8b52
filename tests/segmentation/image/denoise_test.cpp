#include "segmentation/image/denoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mammotwin {
namespace {

constexpr double step_noise = 5;

/// A step of 100 at i = 10, with noise.
Volume<float> noisy_step() {
  Volume<float> image({20, 16, 16}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0);
  std::mt19937 random(5);
  std::normal_distribution<float> gauss(0, step_noise);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 20; ++i) image(i, j, k) = (i < 10 ? 100.0F : 200.0F) + gauss(random);
  return image;
}

double spread(const Volume<float>& image, int i, double mean) {
  double sum = 0;
  for (int k = 2; k < 14; ++k)
    for (int j = 2; j < 14; ++j) sum += std::pow(image(i, j, k) - mean, 2);
  return std::sqrt(sum / 144);
}

TEST(Denoise, AveragesNoiseAndKeepsTheEdge) {
  const Volume<float> out = denoised(noisy_step(), step_noise);
  // About half of 57 neighbours count: noise falls to a fifth to a third; the step of 20 noises
  // lies beyond the likeness, so that the voxels on both sides of it keep their side's level.
  for (const int i : {5, 9}) EXPECT_LT(spread(out, i, 100), 0.4 * step_noise) << i;
  for (const int i : {10, 15}) EXPECT_LT(spread(out, i, 200), 0.4 * step_noise) << i;
}

TEST(Denoise, LeavesAnImageWithoutNoiseAlone) {
  const Volume<float> image = noisy_step();
  EXPECT_EQ(denoised(image, 0).values, image.values);
  const Volume<float> out = denoised(image, 0.01);  // all differences are beyond 4 x 0.025
  for (std::size_t v = 0; v < out.values.size(); ++v)
    EXPECT_NEAR(out.values[v], image.values[v], 0.1);
}

}  // namespace
}  // namespace mammotwin
