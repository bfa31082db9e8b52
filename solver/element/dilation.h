#pragma once

#include <cmath>

namespace mammotwin {

/// U(J) = γ/4 (J² − 1 − 2 ln J) + γ β/4 d⁴ [kPa], d = (J − 1/J)/2, with its derivatives by J: the
/// grad-div stabilisation, γ/2 (J − 1)² near J = 1 and without bound towards J = 0. The quartic
/// term has, with β = 20, 2 % of the first's energy at J = 1.05, as much again at 1.37: it holds
/// points whose volume the pressure space cannot see, as under plates' edges, and leaves the others
/// alone. γ [kPa], J > 0.
struct Dilation {
  double energy, slope, curvature;
};

inline Dilation dilation(double gamma, double beta, double J) {
  const double d = (J - 1 / J) / 2, d1 = (1 + 1 / (J * J)) / 2, d2 = -1 / (J * J * J);
  const double quartic = gamma * beta * d * d;  // d³ and d⁴ follow
  return {gamma / 4 * (J * J - 1 - 2 * std::log(J)) + quartic * d * d / 4,
          gamma * d + quartic * d * d1, gamma * d1 + quartic * (3 * d1 * d1 + d * d2)};
}

}  // namespace mammotwin
