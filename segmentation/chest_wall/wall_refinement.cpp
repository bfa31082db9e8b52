#include "segmentation/chest_wall/wall_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr int reach_mm = 3;  // of the crossing from the wall
constexpr int inner_from_mm = 2, inner_to_mm = 6;
constexpr int outer_from_mm = 2, outer_to_mm = 5;
constexpr double least_step = 0.3;  // of that from fat to muscle
constexpr int nearby_rays = 2;      // rays
constexpr double least_share = 0.25;

/// From the wall to the nearest crossing of the middle; NaN where there is none to be trusted.
double shift_of(const float* ray, int exit, double depth, const WallContrast& contrast) {
  const int at = static_cast<int>(std::lround(depth));
  const double step = contrast.muscle - contrast.fat;
  const double inside = mean_along(ray, at - inner_to_mm, at - inner_from_mm);
  const double outside = mean_along(ray, at + outer_from_mm, at + outer_to_mm);
  if ((inside - outside) / step < least_step) return none;
  const double middle = (inside + outside) / 2;
  double best = none;
  for (int d = std::max(1, at - reach_mm); d <= std::min(exit - 1, at + reach_mm); ++d) {
    const double a = ray[d - 1] - middle, b = ray[d] - middle;
    if (!(a * b <= 0) || a == b || (a - b) / step < 0) continue;
    const double shift = d - 1 + a / (a - b) - depth;
    if (!(std::abs(shift) >= std::abs(best))) best = shift;
  }
  return std::abs(best) <= reach_mm ? best : none;
}

/// Median of those around a ray that have a value.
double median_around(const std::vector<double>& map, int rows, int columns, int r, int c) {
  std::vector<double> near;
  int all = 0;
  for (int b = std::max(0, r - nearby_rays); b <= std::min(rows - 1, r + nearby_rays); ++b)
    for (int a = std::max(0, c - nearby_rays); a <= std::min(columns - 1, c + nearby_rays); ++a) {
      const double value = map[static_cast<std::size_t>(b) * columns + a];
      ++all;
      if (std::isfinite(value)) near.push_back(value);
    }
  if (static_cast<double>(near.size()) < least_share * all) return 0;
  return median(near);
}

}  // namespace

std::vector<double> refined_depths(const PolarRays& rays, const std::vector<double>& depth,
                                   const std::vector<WallContrast>& contrast) {
  std::vector<double> shift(depth.size()), refined(depth);
  for (std::size_t n = 0; n < depth.size(); ++n)
    shift[n] = shift_of(rays.ray(n), rays.exit[n], depth[n], contrast[n]);
  for (std::size_t n = 0; n < depth.size(); ++n)
    refined[n] += median_around(shift, rays.rows, rays.angles, static_cast<int>(n / rays.angles),
                                static_cast<int>(n % rays.angles));
  return refined;
}

}  // namespace mammotwin
