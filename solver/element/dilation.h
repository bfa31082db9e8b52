#pragma once

#include <cmath>

namespace mammotwin {

/// U(J) = γ/4 (J² − 1 − 2 ln J) [kPa] with its derivatives by J: the grad-div stabilisation, γ/2 (J − 1)²
/// near J = 1 and without bound towards J = 0. γ [kPa], J > 0.
struct Dilation {
  double energy, slope, curvature;
};

inline Dilation dilation(double gamma, double J) {
  return {gamma / 4 * (J * J - 1 - 2 * std::log(J)), gamma / 2 * (J - 1 / J),
          gamma / 2 * (1 + 1 / (J * J))};
}

}  // namespace mammotwin
