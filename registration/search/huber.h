#pragma once

#include <cmath>

namespace mammotwin {

/// A residual whose half square is Huber's loss: r^2 / 2 up to `limit`, beyond it growing as |r|
/// does.
inline double huber(double r, double limit) {
  const double size = std::abs(r);
  return size <= limit ? r : std::copysign(std::sqrt(2 * limit * size - limit * limit), r);
}

}  // namespace mammotwin
