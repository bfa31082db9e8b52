#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "pipeline/synthesize/counter_random.h"

namespace mammotwin {

/// Smooth random function of space with features of one length: gradient noise on a unit lattice
/// (Perlin: Improving noise, SIGGRAPH 2002). Values within about [-1, 1], mean 0, C2.
class LatticeNoise {
 public:
  /// `wavelength` [mm] > 0: spacing of the lattice.
  LatticeNoise(std::uint64_t seed, std::uint64_t stream, double wavelength)
      : key_(scramble(scramble(seed) ^ scramble(stream))), frequency_(1 / wavelength) {}

  double operator()(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d p = x * frequency_;
    const Eigen::Vector3d base(std::floor(p.x()), std::floor(p.y()), std::floor(p.z()));
    const Eigen::Vector3d f = p - base;
    const Eigen::Vector3d w(fade(f.x()), fade(f.y()), fade(f.z()));
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d c(corner & 1, (corner >> 1) & 1, corner >> 2);
      const double weight = (c.x() > 0 ? w.x() : 1 - w.x()) * (c.y() > 0 ? w.y() : 1 - w.y()) *
                            (c.z() > 0 ? w.z() : 1 - w.z());
      sum += weight * slope(base + c, f - c);
    }
    return sum;
  }

 private:
  static double fade(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

  /// Scalar product of `offset` with one of the 12 edge directions of a cube.
  double slope(const Eigen::Vector3d& node, const Eigen::Vector3d& offset) const {
    const auto i = static_cast<std::uint64_t>(static_cast<std::int64_t>(node.x()) & 0x1fffff);
    const auto j = static_cast<std::uint64_t>(static_cast<std::int64_t>(node.y()) & 0x1fffff);
    const auto k = static_cast<std::uint64_t>(static_cast<std::int64_t>(node.z()) & 0x1fffff);
    const std::uint64_t hash = scramble(key_ ^ (i | (j << 21) | (k << 42)));
    const int axis = static_cast<int>(hash % 3);
    const double a = offset[(axis + 1) % 3], b = offset[(axis + 2) % 3];
    return ((hash >> 32) & 1 ? a : -a) + ((hash >> 33) & 1 ? b : -b);
  }

  std::uint64_t key_;
  double frequency_;
};

}  // namespace mammotwin
