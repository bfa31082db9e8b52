#pragma once

#include <array>

namespace mammotwin {

/// The cubic Hermite functions on [0,1] and their derivatives at one coordinate t.
///
/// Entry 2·end + order belongs to the value (order 0) or the derivative (order 1) at t = end:
///   h₀ = 1 − 3t² + 2t³   h₁ = t − 2t² + t³   h₂ = 3t² − 2t³   h₃ = t³ − t²
/// so a cubic is p(t) = h₀ p(0) + h₁ p′(0) + h₂ p(1) + h₃ p′(1).
using HermiteValues = std::array<double, 4>;

inline HermiteValues hermite_values(double t) {
  const double s = 1 - t;
  return {s * s * (1 + 2 * t), t * s * s, t * t * (3 - 2 * t), -t * t * s};
}

inline HermiteValues hermite_first_derivatives(double t) {
  const double s = 1 - t;
  return {-6 * t * s, s * (1 - 3 * t), 6 * t * s, t * (3 * t - 2)};
}

inline HermiteValues hermite_second_derivatives(double t) {
  return {12 * t - 6, 6 * t - 4, 6 - 12 * t, 6 * t - 2};
}

/// Derivative of the given order, 0 to 2.
inline HermiteValues hermite_derivatives(double t, int order) {
  return order == 0   ? hermite_values(t)
         : order == 1 ? hermite_first_derivatives(t)
                      : hermite_second_derivatives(t);
}

}  // namespace mammotwin
