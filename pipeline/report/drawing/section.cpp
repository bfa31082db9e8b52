#include "pipeline/report/drawing/section.h"

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

double along(const PaperAxis& a, const Eigen::AlignedBox3d& window, const Eigen::Vector3d& x) {
  return a.reversed ? window.max()[a.axis] - x[a.axis] : x[a.axis] - window.min()[a.axis];
}

double coordinate(const PaperAxis& a, const Eigen::AlignedBox3d& window, double mm) {
  return a.reversed ? window.max()[a.axis] - mm : window.min()[a.axis] + mm;
}

}  // namespace

Eigen::Vector2d Section::on_paper(const Eigen::Vector3d& x) const {
  return {along(right, window, x), along(down, window, x)};
}

Eigen::Vector3d Section::in_space(const Eigen::Vector2d& on_paper) const {
  Eigen::Vector3d x;
  x[normal] = at;
  x[right.axis] = coordinate(right, window, on_paper.x());
  x[down.axis] = coordinate(down, window, on_paper.y());
  return x;
}

Raster Section::sample(double pixel_mm,
                       const std::function<Colour(const Eigen::Vector3d&)>& colour) const {
  const auto count = [&](double mm) {
    return std::max(1, static_cast<int>(std::lround(mm / pixel_mm)));
  };
  Raster raster(count(width_mm()), count(height_mm()));
  for (int row = 0; row < raster.height; ++row)
    for (int column = 0; column < raster.width; ++column)
      raster(column, row) = colour(in_space(
          {(column + 0.5) * width_mm() / raster.width, (row + 0.5) * height_mm() / raster.height}));
  return raster;
}

}  // namespace mammotwin
