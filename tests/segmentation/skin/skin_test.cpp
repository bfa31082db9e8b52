#include "segmentation/skin/skin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "segmentation/skin/skin_surface.h"

namespace mammotwin {
namespace {

/// The pole of a ball of fat of 50 mm with skin, seen through a blur of 0.6 voxels and with Rician
/// noise. The mask's voxels are wrong by up to 0.7 mm, here too large and there too small.
struct Pole {
  static constexpr double radius = 50, half_width = 24, before = 6, behind = 14;
  Volume<float> image;
  Volume<std::uint8_t> body, truth, where;

  Pole(double skin_mm, double skin_level, double voxel, double noise) {
    const int n = static_cast<int>(2 * half_width / voxel);
    const int m = static_cast<int>((before + behind) / voxel);
    image = Volume<float>({n, m, n}, Eigen::Vector3d::Constant(voxel),
                          {-(n - 1) * voxel / 2, -radius - before, -(n - 1) * voxel / 2}, 0);
    body = truth = where = image.like<std::uint8_t>(0);
    const double sigma = 0.6 * voxel;
    const auto step = [&](double x) { return 0.5 * std::erfc(-x / (std::sqrt(2.0) * sigma)); };
    std::mt19937 random(5);
    std::normal_distribution<double> gauss(0, noise);
    for (std::size_t v = 0; v < image.values.size(); ++v) {
      const int i = static_cast<int>(v % n), j = static_cast<int>(v / n % m);
      const Eigen::Vector3d x = image.position(i, j, static_cast<int>(v / n / m));
      const double depth = radius - x.norm();
      const double outer = step(depth), inner = step(depth - skin_mm);
      const double signal = skin_level * (outer - inner) + inner, off = gauss(random);
      image.values[v] = static_cast<float>(std::hypot(signal + off, gauss(random)));
      truth.values[v] = depth > 0;
      body.values[v] = depth > 0.7 * std::sin(x.x() / 4);
      where.values[v] = std::hypot(x.x(), x.z()) < half_width - 7;  // the faces cut skin askew
    }
  }

  /// Voxels of a mask that are wrong, over the voxels that the surface would fill: about the
  /// distance between the surfaces in voxels.
  double share_wrong(const Volume<std::uint8_t>& mask) const {
    double wrong = 0;
    for (std::size_t v = 0; v < mask.values.size(); ++v)
      wrong += where.values[v] && mask.values[v] != truth.values[v];
    const double edge = half_width - 7, area = 3.14159 * edge * edge;
    return wrong * mask.spacing.x() * mask.spacing.y() / area;
  }
};

/// Skin level, voxel [mm], noise over fat.
class Skin : public testing::TestWithParam<std::tuple<double, double, double>> {};

TEST_P(Skin, ThicknessLiesInItsRangeAndTheSurfaceWhereSkinBegins) {
  const auto [level, voxel, noise] = GetParam();
  for (const double thickness : {1.0, 1.5, 2.0, 3.0}) {
    const Pole pole(thickness, level, voxel, noise);
    const SkinSurface surface = find_skin_surface(pole.image, pole.body, pole.where);
    const SkinSlab skin = measure_skin(pole.image, surface.depth, pole.where);
    EXPECT_LE(skin.low, thickness) << thickness;
    EXPECT_GE(skin.high, thickness) << thickness;
    if (thickness >= 2) {
      EXPECT_NEAR(skin.thickness, thickness, 0.5);
    }
    EXPECT_LT(skin.misfit, 0.05);
    // Thin skin is read by its blur: its surface may lie as far off as its thickness. Dark skin of
    // 1 mm at 8 % of noise is not seen at all: the surface is no better than it was.
    const double allowed_mm = thickness >= 2 ? 0.2 : noise < 0.06 ? 0.3 : 0.5;
    EXPECT_LT(pole.share_wrong(surface.body) * voxel, allowed_mm) << thickness;
    EXPECT_GT(pole.share_wrong(pole.body) * voxel, 0.4) << "0.7 mm times the mean of |sin|, 0.64";
  }
}

INSTANTIATE_TEST_SUITE_P(LevelVoxelNoise, Skin,
                         testing::Values(std::tuple{2.0, 1.2, 0.03}, std::tuple{2.0, 1.2, 0.08},
                                         std::tuple{0.45, 1.2, 0.03}, std::tuple{0.45, 1.2, 0.08},
                                         std::tuple{2.0, 0.8, 0.05}, std::tuple{0.45, 0.8, 0.05}));

}  // namespace
}  // namespace mammotwin
