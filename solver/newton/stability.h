#pragma once

#include <vector>

#include "solver/newton/cholesky.h"
#include "solver/newton/sparse_pattern.h"

namespace mammotwin {

/// Smallest eigenvalue λ of K v = λ M v, to 1 %: the stiffness against the softest deformation.
/// `factor` is that of K, which is positive definite; the metric M has `values`, symmetric and
/// semidefinite. Lanczos on K⁻¹ M from a fixed start, so it is the same every time (Saad, Numerical
/// Methods for Large Eigenvalue Problems, sections 6.6 and 9.2).
double smallest_stiffness(const Cholesky& factor, const SparsePattern& pattern,
                          const std::vector<double>& values);

}  // namespace mammotwin
