#include "registration/search/free_form_deformation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mammotwin {
namespace {

constexpr double kSpacing_mm = 25;

/// The four cubic B-splines over one interval, differentiated `order` times, at t in [0, 1].
std::array<double, 4> cubic_splines(double t, int order) {
  const double s = 1 - t;
  switch (order) {
    case 0:
      return {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
              (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6};
    case 1:
      return {-s * s / 2, (3 * t * t - 4 * t) / 2, (-3 * s * s + 4 * s) / 2, t * t / 2};
    case 2:
      return {s, 3 * t - 2, 3 * s - 2, t};
    default:
      return {-1, 3, -3, 1};
  }
}

}  // namespace

FreeFormDeformation::FreeFormDeformation(const Eigen::Vector2d& low, const Eigen::Vector2d& high)
    : first_(low - Eigen::Vector2d::Constant(kSpacing_mm)) {
  columns_ = std::max(1, static_cast<int>(std::ceil((high.x() - low.x()) / kSpacing_mm))) + 3;
  rows_ = std::max(1, static_cast<int>(std::ceil((high.y() - low.y()) / kSpacing_mm))) + 3;
  controls_ = Eigen::Matrix2Xd::Zero(2, columns_ * rows_);
}

Eigen::Vector2d FreeFormDeformation::middle(Eigen::Index control) const {
  return first_ + kSpacing_mm * Eigen::Vector2d(static_cast<double>(control % columns_),
                                                static_cast<double>(control / columns_));
}

Eigen::Vector2d FreeFormDeformation::at(const Eigen::Vector2d& x, int by_depth,
                                        int by_lateral) const {
  Eigen::Vector2d d = Eigen::Vector2d::Zero();
  if (controls_.cols() == 0) return d;
  const Eigen::Vector2d g = (x - first_) / kSpacing_mm;
  const Eigen::Vector2d inside(std::clamp(g.x(), 1.0, columns_ - 2.0),
                               std::clamp(g.y(), 1.0, rows_ - 2.0));
  if ((inside.x() != g.x() && by_depth > 0) || (inside.y() != g.y() && by_lateral > 0)) return d;
  const int i = std::min(static_cast<int>(inside.x()), columns_ - 3);
  const int j = std::min(static_cast<int>(inside.y()), rows_ - 3);
  const auto a = cubic_splines(inside.x() - i, by_depth);
  const auto b = cubic_splines(inside.y() - j, by_lateral);
  for (int n = 0; n < 4; ++n)
    for (int m = 0; m < 4; ++m)
      d += a[m] * b[n] * controls_.col((j - 1 + n) * columns_ + i - 1 + m);
  return d / std::pow(kSpacing_mm, by_depth + by_lateral);
}

HermiteMesh::Node FreeFormDeformation::moved(const HermiteMesh::Node& node) const {
  const Eigen::Vector2d x = node.col(0).head<2>();
  std::array<std::array<Eigen::Vector2d, 4>, 4> d;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; i + j < 4; ++j) d[i][j] = at(x, i, j);
  const auto along = [&](int parameter) -> Eigen::Vector2d {
    return node.col(parameter).head<2>();
  };
  const auto first = [&](const Eigen::Vector2d& a) -> Eigen::Vector2d {
    return d[1][0] * a.x() + d[0][1] * a.y();
  };
  const auto second = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) -> Eigen::Vector2d {
    return d[2][0] * a.x() * b.x() + d[1][1] * (a.x() * b.y() + a.y() * b.x()) +
           d[0][2] * a.y() * b.y();
  };
  const auto third = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                         const Eigen::Vector2d& c) -> Eigen::Vector2d {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int bits = 0; bits < 8; ++bits) {
      const int i = bits & 1, j = bits >> 1 & 1, k = bits >> 2 & 1, lateral = i + j + k;
      sum += d[3 - lateral][lateral] * a[i] * b[j] * c[k];
    }
    return sum;
  };
  HermiteMesh::Node moved = node;
  moved.col(0).head<2>() += d[0][0];
  for (const int p : {1, 2, 4}) moved.col(p).head<2>() += first(along(p));
  for (const auto& [p, a, b] : {std::array{3, 1, 2}, std::array{5, 1, 4}, std::array{6, 2, 4}})
    moved.col(p).head<2>() += first(along(p)) + second(along(a), along(b));
  moved.col(7).head<2>() += first(along(7)) + second(along(3), along(4)) +
                            second(along(5), along(2)) + second(along(6), along(1)) +
                            third(along(1), along(2), along(4));
  return moved;
}

}  // namespace mammotwin
