#pragma once

#include <Eigen/Core>

namespace mammotwin {

/// How far a map is from turning and scaling only, finite for folded maps too (Garanzha et al.,
/// "Foldover-free maps in 50 lines of code", ACM Trans. Graph. 40(4), 2021):
///
///   e(F) = |F|² / (3 g^⅔) + w (d² + 1) / (2 g),   d = det F,   g = (d + √(d² + ε²)) / 2,
///
/// with w = 0.05. e = 1 + w for a turned unit cube; F is dimensionless.
struct FoldoverEnergy {
  double epsilon = 1e-3;

  /// ε for a mesh whose smallest determinant is d_min: √(10⁻⁶ + 0.04 min(d_min, 0)²).
  static FoldoverEnergy for_smallest(double d_min);

  using Gradient = Eigen::Matrix<double, 9, 1>;  ///< by F(row, column) at row + 3·column
  using Hessian = Eigen::Matrix<double, 9, 9>;

  double value(const Eigen::Matrix3d& F) const;
  Gradient gradient(const Eigen::Matrix3d& F) const;
  Hessian hessian(const Eigen::Matrix3d& F) const;

  /// The Hessian with its negative eigenvalues set to zero.
  Hessian positive_hessian(const Eigen::Matrix3d& F) const;
};

}  // namespace mammotwin
