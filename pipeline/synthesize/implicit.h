#pragma once

#include <algorithm>
#include <cmath>

namespace mammotwin {

/// 0 below `from`, 1 above `to`, a cubic with flat ends between.
inline double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Union of two bodies given by signed distances a, b [mm] (negative inside) with a fillet of
/// about `width` [mm] where they meet (polynomial smooth minimum: Quilez, Smooth minimum, 2013).
inline double smooth_union(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width / 4;
}

}  // namespace mammotwin
