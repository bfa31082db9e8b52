#include "pipeline/validation/lagrange/lagrange_element.h"

#include <stdexcept>

namespace mammotwin {

namespace {

/// Value (0) or derivative (1) of the one-dimensional function n at t.
double lagrange(int order, int n, int derivative, double t) {
  if (order == 1) return derivative ? (n == 0 ? -1 : 1) : (n == 0 ? 1 - t : t);
  switch (n) {
    case 0:
      return derivative ? 4 * t - 3 : (1 - t) * (1 - 2 * t);
    case 1:
      return derivative ? 4 - 8 * t : 4 * t * (1 - t);
    default:
      return derivative ? 4 * t - 1 : t * (2 * t - 1);
  }
}

}  // namespace

LagrangeElement::LagrangeElement(int order) : order_(order) {
  if (order != 1 && order != 2)
    throw std::invalid_argument("Lagrange element: order is " + std::to_string(order) +
                                "; expected 1 or 2");
  const int n = order + 1;
  T_.resize(kFunctions, n * n * n);
  for (int a = 0; a < kFunctions; ++a)
    for (int node = 0; node < n * n * n; ++node) {
      const int t[3] = {a & 3, a >> 2 & 3, a >> 4}, k[3] = {node % n, node / n % n, node / (n * n)};
      T_(a, node) = 1;
      for (int i = 0; i < 3; ++i) T_(a, node) *= lagrange(order, k[i], t[i] & 1, t[i] >> 1);
    }
}

Eigen::Vector3d LagrangeElement::xi(int node) const {
  const int n = order_ + 1;
  return Eigen::Vector3d(node % n, node / n % n, node / (n * n)) / order_;
}

}  // namespace mammotwin
