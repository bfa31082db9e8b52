#pragma once

#include <vector>

namespace mammotwin {

/// Gauss-Legendre points and weights on [0, 1]; exact for polynomials of degree 2n - 1.
struct GaussRule {
  std::vector<double> points, weights;
};

/// The rule of n points, found by Newton on the Legendre polynomial.
GaussRule gauss_rule(int n);

}  // namespace mammotwin
