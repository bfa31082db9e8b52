#pragma once

#include <array>

namespace mammotwin {

/// Gauss-Legendre points and weights on [0, 1]; exact for polynomials of degree 2n - 1.
template <int n>
struct GaussRule {
  std::array<double, n> points, weights;
};

/// The n-point rule for n = 4, 5 or 6; found by Newton on the Legendre polynomial.
template <int n>
GaussRule<n> gauss_rule();

}  // namespace mammotwin
