#include "fitting/mesh/jacobian_bound.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "fitting/mesh/bezier_evaluation.h"

namespace mammotwin {

namespace {

constexpr int degree = 8;  // 3 + 3 + 2 from the three columns
constexpr int n = degree + 1;
constexpr int max_halvings = 8;
// Coefficients come from products of 9 x 9 matrices of norm below 1e3: rounding stays below
// 1e3^3 * 1e-16 of the largest determinant.
constexpr double rounding = 1e-7;
constexpr double wanted_gap = 0.01;

using Matrix9 = Eigen::Matrix<double, n, n>;
using Box = std::array<double, n * n * n>;  // coefficient at i + n(j + n k)

double chebyshev(int i) { return 0.5 - 0.5 * std::cos(std::numbers::pi * (i + 0.5) / n); }

double binomial(int top, int bottom) {
  double value = 1;
  for (int i = 0; i < bottom; ++i) value *= static_cast<double>(top - i) / (i + 1);
  return value;
}

/// Bernstein coefficients from values at the Chebyshev points.
Matrix9 coefficients_from_samples() {
  Matrix9 b;
  for (int row = 0; row < n; ++row)
    for (int i = 0; i < n; ++i) {
      const double t = chebyshev(row);
      b(row, i) = binomial(degree, i) * std::pow(t, i) * std::pow(1 - t, degree - i);
    }
  return b.inverse();
}

/// Coefficients of the lower (upper = false) or upper half from those of the whole.
Matrix9 halving(bool upper) {
  Matrix9 h = Matrix9::Zero();
  for (int i = 0; i < n; ++i)
    for (int a = 0; a <= i; ++a)
      h(upper ? degree - i : i, upper ? degree - a : a) = binomial(i, a) / std::pow(2.0, i);
  return h;
}

void apply(const Matrix9& m, int stride, Box& box) {
  for (int start = 0; start < n * n * n; ++start) {
    if (start / stride % n != 0) continue;
    Eigen::Map<Eigen::Matrix<double, n, 1>, 0, Eigen::InnerStride<>> line(
        box.data() + start, Eigen::InnerStride<>(stride));
    line = (m * line).eval();
  }
}

/// Bernstein coefficients of the determinant in one element.
Box determinant_coefficients(const PaddedBezierElement& element) {
  static const Matrix9 transform = coefficients_from_samples();
  Box box;
  for (int m = 0; m < n * n * n; ++m) {
    const Eigen::Vector3d xi(chebyshev(m % n), chebyshev(m / n % n), chebyshev(m / (n * n)));
    box[m] = evaluate(element, xi).jacobian.determinant();
  }
  for (int stride : {1, n, n * n}) apply(transform, stride, box);
  return box;
}

double smallest_corner(const Box& box) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int c = 0; c < 8; ++c)
    smallest = std::min(smallest, box[degree * ((c & 1) + n * ((c >> 1 & 1) + n * (c >> 2)))]);
  return smallest;
}

/// Depth-first search for the smallest determinant of one element.
struct Search {
  double floor;  ///< boxes bounded above this are done
  double gap;    ///< so are boxes within this of the smallest value met
  double slack;  ///< for rounding
  bool stop_below_zero;
  double lower = std::numeric_limits<double>::infinity();
  double sampled = std::numeric_limits<double>::infinity();

  void visit(const Box& box, int level) {
    sampled = std::min(sampled, smallest_corner(box));
    const double bound = *std::min_element(box.begin(), box.end()) - slack;
    const bool disproved = stop_below_zero && sampled <= 0;
    const bool close = bound > sampled - gap && (bound > 0 || sampled <= 0);
    if (disproved || bound > floor || close || level == max_halvings) {
      lower = std::min(lower, bound);
      return;
    }
    static const std::array<Matrix9, 2> half = {halving(false), halving(true)};
    for (int c = 0; c < 8; ++c) {
      Box part = box;
      apply(half[c & 1], 1, part);
      apply(half[c >> 1 & 1], n, part);
      apply(half[c >> 2], n * n, part);
      visit(part, level + 1);
      if (stop_below_zero && (sampled <= 0 || lower <= 0)) return;
    }
  }
};

double slack(const Box& box) {
  double largest = 0;
  for (double c : box) largest = std::max(largest, std::abs(c));
  return rounding * largest;
}

bool proved(const HermiteMesh& mesh, int element) {
  const Box box = determinant_coefficients(padded(bezier_element(mesh, element)));
  Search search{0, 0, slack(box), true};
  search.visit(box, 0);
  return search.lower > 0;
}

double mean(const Box& box) {
  double sum = 0;
  for (double c : box) sum += c;
  return sum / box.size();
}

}  // namespace

bool proved_valid(const HermiteMesh& mesh) {
  std::atomic<bool> valid = true;
  tbb::parallel_for(0, mesh.num_elements(), [&](int e) {
    if (valid && !proved(mesh, e)) valid = false;
  });
  return valid;
}

std::vector<JacobianBound> bound_elements(const HermiteMesh& mesh) {
  const int count = mesh.num_elements();
  std::vector<Box> boxes(count);
  tbb::parallel_for(0, count, [&](int e) {
    boxes[e] = determinant_coefficients(padded(bezier_element(mesh, e)));
  });
  double mean_determinant = 0;
  for (const Box& box : boxes) mean_determinant += std::abs(mean(box)) / count;
  std::vector<JacobianBound> bounds(count);
  tbb::parallel_for(0, count, [&](int e) {
    Search search{std::numeric_limits<double>::infinity(), wanted_gap * mean_determinant,
                  slack(boxes[e]), false};
    search.visit(boxes[e], 0);
    bounds[e] = {search.lower / mean_determinant, search.sampled / mean_determinant};
  });
  return bounds;
}

JacobianBound bound_jacobian(const HermiteMesh& mesh) {
  JacobianBound smallest{std::numeric_limits<double>::infinity(),
                         std::numeric_limits<double>::infinity()};
  for (const JacobianBound& bound : bound_elements(mesh)) {
    smallest.lower = std::min(smallest.lower, bound.lower);
    smallest.sampled = std::min(smallest.sampled, bound.sampled);
  }
  return smallest;
}

std::vector<double> scaled_jacobians(const HermiteMesh& mesh) {
  constexpr int samples = 7;
  std::vector<double> smallest(mesh.num_elements(), std::numeric_limits<double>::infinity());
  tbb::parallel_for(0, mesh.num_elements(), [&](int e) {
    const PaddedBezierElement element = padded(bezier_element(mesh, e));
    for (int m = 0; m < samples * samples * samples; ++m) {
      const Eigen::Vector3d at(m % samples, m / samples % samples, m / (samples * samples));
      const Eigen::Matrix3d j = evaluate(element, at / (samples - 1)).jacobian;
      smallest[e] = std::min(smallest[e], j.determinant() / j.colwise().norm().prod());
    }
  });
  return smallest;
}

}  // namespace mammotwin
