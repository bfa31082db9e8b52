#include "pipeline/synthesize/gel_breast.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <stdexcept>

namespace mammotwin {
namespace {

constexpr double half_side_mm = 85;
constexpr int num_points = 19000;
constexpr double noise_mm = 0.3;
constexpr double outlier_share = 0.01;

/// Area of skin per area of (s, t), by differences.
double stretch(double s, double t) {
  constexpr double h = 1e-3;
  const Eigen::Vector3d by_s = gel_breast_skin(s + h, t) - gel_breast_skin(s - h, t);
  const Eigen::Vector3d by_t = gel_breast_skin(s, t + h) - gel_breast_skin(s, t - h);
  return by_s.cross(by_t).norm() / (4 * h * h);
}

bool in_hole(const Eigen::Vector3d& x, const ScanHoles& holes) {
  return std::any_of(holes.middles.begin(), holes.middles.end(),
                     [&](const Eigen::Vector3d& m) { return (x - m).norm() < holes.radius_mm; });
}

}  // namespace

Eigen::Vector3d gel_breast_skin(double s, double t) {
  const double rho = std::hypot(s, t);
  const double h = 62 * std::exp(-std::pow(rho / 50, 3)) +
                   5 * std::exp(-(s * s + (t + 4) * (t + 4)) / (2 * 4 * 4));
  return {s, s * s / 800 - h, t - h / 4};
}

TriangleSurface gel_breast_surface(double step_mm) {
  const int n = static_cast<int>(std::ceil(2 * half_side_mm / step_mm));
  TriangleSurface surface;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      surface.vertices.push_back(
          gel_breast_skin(half_side_mm * (2.0 * i / n - 1), half_side_mm * (2.0 * j / n - 1)));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int v = i + (n + 1) * j;
      surface.triangles.push_back({v, v + 1, v + n + 2});
      surface.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  return surface;
}

ScanHoles gel_breast_holes() {
  // Under the fold, on the medial flank, and between nipple and axilla: where scanners lose sight.
  return {{gel_breast_skin(5, -52), gel_breast_skin(-40, 10), gel_breast_skin(30, 28)}};
}

std::vector<Eigen::Vector3d> gel_breast_scan(int seed) {
  std::mt19937 random(seed);
  // Not std:: distributions, whose values differ between libraries.
  const auto uniform = [&] { return (random() + 0.5) / 4294967296.0; };
  const auto gaussian = [&] {
    return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * 3.14159265358979 * uniform());
  };
  const ScanHoles holes = gel_breast_holes();
  constexpr double largest_stretch = 3.5;
  std::vector<Eigen::Vector3d> points;
  while (points.size() < num_points) {
    if (uniform() < outlier_share) {
      points.push_back({half_side_mm * (2 * uniform() - 1), -70 + 80 * uniform(),
                        half_side_mm * (2 * uniform() - 1)});
      continue;
    }
    const double s = half_side_mm * (2 * uniform() - 1), t = half_side_mm * (2 * uniform() - 1);
    if (uniform() * largest_stretch > stretch(s, t)) continue;
    const Eigen::Vector3d x = gel_breast_skin(s, t);
    if (in_hole(x, holes)) continue;
    points.push_back(x + noise_mm * Eigen::Vector3d(gaussian(), gaussian(), gaussian()));
  }
  return points;
}

void write_point_ply(const std::filesystem::path& path,
                     const std::vector<Eigen::Vector3d>& points) {
  std::ofstream file(path, std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\ncomment unit mm\nelement vertex " << points.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (const auto& x : points) {
    const Eigen::Vector3f single = x.cast<float>();
    file.write(reinterpret_cast<const char*>(single.data()), sizeof(float) * 3);
  }
  if (!file.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace mammotwin
