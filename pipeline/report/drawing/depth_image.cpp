#include "pipeline/report/drawing/depth_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mammotwin {

DepthImage::DepthImage(int width, int height, const Eigen::Vector2d& lower_left, double pixel_mm)
    : raster_(width, height),
      nearest_(static_cast<std::size_t>(width) * height, -std::numeric_limits<double>::infinity()),
      lower_left_(lower_left),
      pixel_mm_(pixel_mm) {}

Eigen::Vector2d DepthImage::pixel(const Eigen::Vector3d& x) const {
  const Eigen::Vector2d from_corner = (x.head<2>() - lower_left_) / pixel_mm_;
  return {from_corner.x(), raster_.height - from_corner.y()};
}

void DepthImage::triangle(const std::array<Eigen::Vector3d, 3>& x, const Colour& colour) {
  const Eigen::Vector2d a = pixel(x[0]), b = pixel(x[1]), c = pixel(x[2]);
  const auto cross = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return p.x() * q.y() - p.y() * q.x();
  };
  const double area = cross(b - a, c - a);
  if (area == 0) return;
  const auto first = [](double v) { return std::max(0, static_cast<int>(std::floor(v))); };
  const int right = std::min<int>(raster_.width - 1, std::ceil(std::max({a.x(), b.x(), c.x()})));
  const int bottom = std::min<int>(raster_.height - 1, std::ceil(std::max({a.y(), b.y(), c.y()})));
  for (int row = first(std::min({a.y(), b.y(), c.y()})); row <= bottom; ++row)
    for (int column = first(std::min({a.x(), b.x(), c.x()})); column <= right; ++column) {
      const Eigen::Vector2d p(column + 0.5, row + 0.5);
      const double wb = cross(p - a, c - a) / area, wc = cross(b - a, p - a) / area;
      if (wb < 0 || wc < 0 || wb + wc > 1) continue;
      const double z = (1 - wb - wc) * x[0].z() + wb * x[1].z() + wc * x[2].z();
      double& nearest = nearest_[static_cast<std::size_t>(row) * raster_.width + column];
      if (z <= nearest) continue;
      nearest = z;
      raster_(column, row) = colour;
    }
}

}  // namespace mammotwin
