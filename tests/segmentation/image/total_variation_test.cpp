#include "segmentation/image/total_variation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mammotwin {
namespace {

/// Convolved along each axis with three taps of the Gaussian's variance.
Volume<float> blurred(Volume<float> image, double sigma) {
  const auto side = static_cast<float>(sigma * sigma / 2);
  for (int axis = 0; axis < 3; ++axis) {
    const Volume<float> in = image;
    for (int k = 0; k < in.size.z(); ++k)
      for (int j = 0; j < in.size.y(); ++j)
        for (int i = 0; i < in.size.x(); ++i) {
          const auto beside = [&](int step) {
            Eigen::Vector3i at(i, j, k);
            at[axis] = std::clamp(at[axis] + step, 0, in.size[axis] - 1);
            return in(at.x(), at.y(), at.z());
          };
          image(i, j, k) = (1 - 2 * side) * in(i, j, k) + side * (beside(-1) + beside(1));
        }
  }
  return image;
}

/// A step from 1 to 2 at i = 12; noise of 5 % on the first half of the slices, 20 % on the others.
struct NoisyStep {
  Volume<float> truth{{24, 20, 20}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0};
  Volume<float> noise = truth, image = truth;

  explicit NoisyStep(double blur = 0) {
    for (int k = 0; k < 20; ++k)
      for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 24; ++i) {
          truth(i, j, k) = i < 12 ? 1 : 2;
          noise(i, j, k) = k < 10 ? 0.05F : 0.2F;
        }
    image = blurred(truth, blur);
    std::mt19937 random(7);
    std::normal_distribution<float> gauss(0, 1);
    for (std::size_t v = 0; v < image.values.size(); ++v)
      image.values[v] += noise.values[v] * gauss(random);
  }

  double error(const Volume<float>& found, int k_low, int k_high) const {
    double sum = 0, count = 0;
    for (int k = k_low; k < k_high; ++k)
      for (int j = 1; j < 19; ++j)
        for (int i = 1; i < 23; ++i, ++count) sum += std::pow(found(i, j, k) - truth(i, j, k), 2);
    return std::sqrt(sum / count);
  }
};

TEST(TotalVariation, TakesOutMoreWhereThereIsMoreNoise) {
  const NoisyStep scene;
  const Volume<float> found = total_variation_restored(scene.image, scene.noise, 0.5, 0);
  // A piecewise constant image is what the method is made for: noise falls to a third at least.
  EXPECT_LT(scene.error(found, 1, 9), 0.05 / 3);
  EXPECT_LT(scene.error(found, 11, 19), 0.2 / 3);
}

class Blur : public testing::TestWithParam<double> {};

TEST_P(Blur, MinimisesTheEnergy) {
  const NoisyStep scene(GetParam());
  constexpr double strength = 0.5;
  const auto energy = [&](const Volume<float>& u) {
    const Volume<float> seen = blurred(u, GetParam());
    double sum = 0;
    for (int k = 0; k < 20; ++k)
      for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 24; ++i) {
          const double s = scene.noise(i, j, k), here = u(i, j, k);
          const double x = i < 23 ? u(i + 1, j, k) - here : 0;
          const double y = j < 19 ? u(i, j + 1, k) - here : 0;
          const double z = k < 19 ? u(i, j, k + 1) - here : 0;
          sum += std::pow((seen(i, j, k) - scene.image(i, j, k)) / s, 2) / 2 +
                 strength * std::sqrt(x * x + y * y + z * z) / s;
        }
    return sum;
  };
  const Volume<float> found =
      total_variation_restored(scene.image, scene.noise, strength, GetParam());
  const double least = energy(found);
  EXPECT_LT(least, energy(scene.image));
  EXPECT_LT(least, energy(scene.truth));
  // Convex, so no step from it may gain, but for what the rounds leave.
  std::mt19937 random(8);
  std::normal_distribution<float> gauss(0, 0.01F);
  for (int trial = 0; trial < 5; ++trial) {
    Volume<float> other = found;
    for (float& value : other.values) value += gauss(random);
    EXPECT_LT(least, energy(other));
  }
  for (const Volume<float>* towards : {&scene.image, &scene.truth}) {
    Volume<float> other = found;
    for (std::size_t v = 0; v < other.values.size(); ++v)
      other.values[v] += 0.05F * (towards->values[v] - other.values[v]);
    EXPECT_LT(least, 1.003 * energy(other));
  }
}

INSTANTIATE_TEST_SUITE_P(TotalVariation, Blur, testing::Values(0, 0.55));

TEST(TotalVariation, TakesOutTheBlur) {
  constexpr double blur = 0.55;
  const NoisyStep scene(blur);
  const auto edge = [](const Volume<float>& u) {  // mean step from i = 11 to 12, of 1
    double sum = 0;
    for (int k = 1; k < 9; ++k)
      for (int j = 1; j < 19; ++j) sum += u(12, j, k) - u(11, j, k);
    return sum / (8 * 18);
  };
  EXPECT_LT(edge(scene.image), 0.75);
  EXPECT_GT(edge(total_variation_restored(scene.image, scene.noise, 0.3, blur)), 0.9);
}

TEST(TotalVariation, FillsWhatIsNotKnownFromAround) {
  NoisyStep scene;
  for (int k = 4; k < 7; ++k)
    for (int j = 8; j < 11; ++j)
      for (int i = 3; i < 6; ++i) scene.noise(i, j, k) = 0, scene.image(i, j, k) = 100;
  const Volume<float> found = total_variation_restored(scene.image, scene.noise, 0.5, 0.55);
  EXPECT_LT(std::abs(found(2, 9, 5) - 1), 0.1);  // what is beside it has not heard of the 100
}

TEST(TotalVariation, LeavesAnImageWithoutNoiseAlone) {
  const NoisyStep scene;
  const Volume<float> none = scene.image.like<float>(0);
  EXPECT_EQ(total_variation_restored(scene.image, none, 0.5, 0.55).values, scene.image.values);
}

}  // namespace
}  // namespace mammotwin
