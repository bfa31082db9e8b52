#include "solver/element/gauss.h"

#include <cmath>
#include <utility>

namespace mammotwin {

namespace {

/// Legendre polynomial of degree n at x and its derivative (Bonnet's recursion).
std::pair<double, double> legendre(int n, double x) {
  double previous = 1, value = x;  // n >= 1
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, n * (previous - x * value) / (1 - x * x)};
}

}  // namespace

GaussRule gauss_rule(int n) {
  constexpr double pi = 3.14159265358979323846;
  constexpr int newton_steps = 10;  // quadratic from a guess good to 1e-2
  GaussRule rule{std::vector<double>(n), std::vector<double>(n)};
  for (int q = 0; q < n; ++q) {
    double x = -std::cos(pi * (q + 0.75) / (n + 0.5));
    for (int step = 0; step < newton_steps; ++step) {
      const auto [value, slope] = legendre(n, x);
      x -= value / slope;
    }
    const double slope = legendre(n, x).second;
    rule.points[q] = (1 + x) / 2;
    rule.weights[q] = 1 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace mammotwin
