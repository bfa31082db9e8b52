#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "segmentation/image/volume.h"
#include "tests/segmentation/filtered.h"

namespace mammotwin {

/// A crude prone patient in closed form, for tests: two half-ellipsoid breasts on a round chest.
/// Skin over fat, a ball of gland and a ball of lesion in the left breast, a muscle sheet with a
/// grey thorax behind it.
struct Phantom {
  double voxel_mm = 2;
  double skin_mm = 2.5;
  bool fat_suppressed = true;
  double noise = 0.02;       ///< over fat
  bool is_filtered = false;  ///< the image with its noise, before its magnitude is taken
  double shading = 0.0;      ///< log of the change over the image's depth
  double fat_grey = 200;
  bool contrast_agent = false;  ///< not suppressed: lesion 0.95 for 0.42, gland 0.55 for 0.45

  static constexpr double chest_radius = 150, muscle_mm = 14, coat_mm = 14;
  Eigen::Vector3d chest_axis{0, 190, 0};  ///< x, y of a vertical cylinder; its front is at y = 40
  Eigen::Vector3d left_base{75, 50, 0}, right_base{-75, 50, 0};
  Eigen::Vector3d semi_axes{52, 75, 60};
  Eigen::Vector3d gland{75, 5, 0};
  double gland_radius = 18;
  Eigen::Vector3d lesion{88, 20, 18};
  double lesion_radius = 8;

  /// How far a point lies inside the skin, roughly [mm]; negative outside.
  double depth(const Eigen::Vector3d& x) const {
    const double chest =
        chest_radius + coat_mm - std::hypot(x.x() - chest_axis.x(), x.y() - chest_axis.y());
    const auto ball = [&](const Eigen::Vector3d& base) {
      return (1 - (x - base).cwiseQuotient(semi_axes).norm()) * semi_axes.minCoeff();
    };
    return std::max({chest, ball(left_base), ball(right_base)});
  }

  /// Distance in front of the muscle [mm]; negative behind its front.
  double before_wall(const Eigen::Vector3d& x) const {
    return std::hypot(x.x() - chest_axis.x(), x.y() - chest_axis.y()) - chest_radius;
  }

  double brightness(const Eigen::Vector3d& x) const {
    const double d = depth(x), w = before_wall(x);
    const bool fs = fat_suppressed;
    if (d < 0) return 0;
    if (w < -muscle_mm) return fs ? 1.3 : 0.45;  // thorax
    if (w < 0) return fs ? 1.55 : 0.4;
    if (d < skin_mm) return fs ? 2.0 : 0.45;
    if ((x - lesion).norm() < lesion_radius) return fs ? 3.2 : contrast_agent ? 0.95 : 0.42;
    if ((x - gland).norm() < gland_radius) return fs ? 1.8 : contrast_agent ? 0.55 : 0.45;
    return 1;
  }

  /// The image, each voxel the mean of 2 x 2 x 2 points, with shading and Rician noise.
  Volume<float> image() const {
    const Eigen::Vector3d extent(320, 170, 180), low(-160, -50, -90);
    const Eigen::Vector3i size = (extent / voxel_mm).array().round().cast<int>().matrix();
    Volume<float> out(size, Eigen::Vector3d::Constant(voxel_mm),
                      low + Eigen::Vector3d::Constant(voxel_mm / 2), 0);
    Volume<float> imaginary = out;
    std::mt19937 random(3);
    std::normal_distribution<double> gauss(0, noise);
    for (int k = 0; k < size.z(); ++k)
      for (int j = 0; j < size.y(); ++j)
        for (int i = 0; i < size.x(); ++i) {
          const Eigen::Vector3d x = out.position(i, j, k);
          double sum = 0;
          for (int corner = 0; corner < 8; ++corner) {
            const Eigen::Vector3d step(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
            sum += brightness(x + (step.array() - 0.5).matrix() * voxel_mm / 2) / 8;
          }
          const double coil = std::exp(-shading * (x.y() - low.y()) / extent.y());
          out(i, j, k) = static_cast<float>(fat_grey * (sum * coil + gauss(random)));
          imaginary(i, j, k) = static_cast<float>(fat_grey * gauss(random));
        }
    if (is_filtered) out = filtered(out), imaginary = filtered(imaginary);
    for (std::size_t v = 0; v < out.values.size(); ++v)
      out.values[v] = std::hypot(out.values[v], imaginary.values[v]);
    return out;
  }
};

}  // namespace mammotwin
