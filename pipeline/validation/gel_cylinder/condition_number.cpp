#include "pipeline/validation/gel_cylinder/condition_number.h"

#include <cmath>
#include <functional>
#include <limits>

#include "solver/newton/assembler.h"
#include "solver/newton/cholesky.h"
#include "solver/newton/sparse_pattern.h"

namespace mammotwin {

namespace {

using Eigen::VectorXd;

VectorXd diagonal(const SparsePattern& pattern, const std::vector<double>& values) {
  VectorXd d = VectorXd::Zero(pattern.num_columns());
  for (int c = 0; c < pattern.num_columns(); ++c)
    for (int k = pattern.starts[c]; k < pattern.starts[c + 1]; ++k)
      if (pattern.rows[k] == c) d[c] += values[k];
  return d;
}

/// Largest eigenvalue of a positive definite operator, from a start that repeats.
double largest_eigenvalue(int n, const std::function<VectorXd(const VectorXd&)>& apply) {
  constexpr int most = 2000;
  constexpr double settled = 1e-5;
  VectorXd x(n);
  for (int i = 0; i < n; ++i) x[i] = std::sin(1.0 + i);
  double value = 0;
  for (int k = 0; k < most; ++k) {
    x.normalize();
    const VectorXd y = apply(x);
    const double next = x.dot(y);
    x = y;
    if (std::abs(next - value) <= settled * next) return next;
    value = next;
  }
  return value;
}

}  // namespace

double condition_number(const Model& model, const DofMap& dofs, const State& state) {
  Assembler assembler(model, dofs);
  Cholesky cholesky(assembler.pattern(), dofs.node_of_equation());
  assembler.linearise(state, {});
  const auto& values = assembler.matrix();
  if (!cholesky.factor(values)) return std::numeric_limits<double>::infinity();
  const VectorXd root = diagonal(assembler.pattern(), values).cwiseSqrt();
  const int n = assembler.num_equations();
  const double largest = largest_eigenvalue(n, [&](const VectorXd& x) -> VectorXd {
    return multiply(assembler.pattern(), values, x.cwiseQuotient(root)).cwiseQuotient(root);
  });
  const double inverse = largest_eigenvalue(n, [&](const VectorXd& x) -> VectorXd {
    return root.cwiseProduct(cholesky.solve(root.cwiseProduct(x)));
  });
  return largest * inverse;
}

}  // namespace mammotwin
