#include "segmentation/tissue/fibroglandular.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mammotwin {
namespace {

/// Fat at 1 with blobs of gland, half-filled voxels at their rims, a bias of +-20 % and noise.
struct Tissue {
  Volume<float> image{{60, 60, 60}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0};
  Volume<float> truth = image;
  Volume<std::uint8_t> all = image.like<std::uint8_t>(1);

  explicit Tissue(double gland) {
    std::mt19937 random(11);
    std::normal_distribution<double> noise(0, 0.03);
    for (int k = 0; k < 60; ++k)
      for (int j = 0; j < 60; ++j)
        for (int i = 0; i < 60; ++i) {
          const double wave = std::sin(i * 0.33) * std::sin(j * 0.29) * std::sin(k * 0.31);
          const double fraction = std::clamp(4 * (wave - 0.3), 0.0, 1.0);
          truth(i, j, k) = static_cast<float>(fraction);
          const double bias = 1 + 0.2 * std::sin(i * 0.05);
          image(i, j, k) = static_cast<float>((1 + fraction * (gland - 1)) * bias + noise(random));
        }
  }

  double dice(const TissueSplit& split) const {
    double both = 0, sum = 0;
    for (std::size_t v = 0; v < truth.values.size(); ++v) {
      const bool a = truth.values[v] > 0.5F, b = split.gland_fraction.values[v] > 0.5F;
      both += a && b, sum += a + b;
    }
    return 2 * both / sum;
  }
};

TEST(Fibroglandular, IsToldFromFatOnBothContrasts) {
  for (const double gland : {1.8, 0.45}) {
    const Tissue tissue(gland);
    const TissueSplit split = split_tissue(tissue.image, tissue.all, tissue.all, gland > 1);
    EXPECT_NEAR(split.gland, gland, 0.1);
    EXPECT_GT(tissue.dice(split), 0.93) << gland;
  }
}

TEST(Fibroglandular, VesselsDoNotPassForIt) {
  Tissue tissue(1);  // fat alone, and bias
  const auto gland_at = [](int i, int j, int k) {
    return Eigen::Vector3d(i % 30 - 10, j % 30 - 10, k % 30 - 15).norm() < 4;
  };
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i) {
        if (gland_at(i, j, k)) tissue.image(i, j, k) *= 1.8F;
        if (std::hypot(i - 25, j - 25) < 5) tissue.image(i, j, k) *= 6;  // more than all gland
      }
  const TissueSplit split = split_tissue(tissue.image, tissue.all, tissue.all, true);
  EXPECT_NEAR(split.gland, 1.8, 0.1);
  double found = 0, gland = 0;
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i)
        if (gland_at(i, j, k)) found += split.gland_fraction(i, j, k) > 0.5F, ++gland;
  EXPECT_GT(found, 0.98 * gland);
}

TEST(Fibroglandular, ABreastOfFatHasNone) {
  Tissue tissue(1);
  const TissueSplit split = split_tissue(tissue.image, tissue.all, tissue.all, true);
  double volume = 0;
  for (const float f : split.gland_fraction.values) volume += f > 0.5F;
  EXPECT_LT(volume, 0.001 * static_cast<double>(tissue.all.values.size()));
}

}  // namespace
}  // namespace mammotwin
