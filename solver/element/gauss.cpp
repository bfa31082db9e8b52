#include "solver/element/gauss.h"

#include <cmath>
#include <utility>

namespace mammotwin {

namespace {

/// Legendre polynomial of degree n at x and its derivative (Bonnet's recursion).
std::pair<double, double> legendre(int n, double x) {
  double previous = 1, value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, n * (previous - x * value) / (1 - x * x)};
}

}  // namespace

template <int n>
GaussRule<n> gauss_rule() {
  constexpr double pi = 3.14159265358979323846;
  constexpr int newton_steps = 10;  // quadratic from a guess good to 1e-2
  GaussRule<n> rule;
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

template GaussRule<4> gauss_rule<4>();
template GaussRule<5> gauss_rule<5>();
template GaussRule<6> gauss_rule<6>();

}  // namespace mammotwin
