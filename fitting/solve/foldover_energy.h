#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace mammotwin {

/// How far a map is from turning and scaling only, finite for folded maps too (Garanzha et al.,
/// "Foldover-free maps in 50 lines of code", ACM Trans. Graph. 40(4), 2021):
///
///   e(F) = |F|² / (3 g^⅔) + w (d² + 1) / (2 g),   d = det F,   g = (d + √(d² + ε²)) / 2,
///
/// with w = 0.05. e = 1 + w for a turned unit cube; F is dimensionless. It is a sum of squares.
struct FoldoverEnergy {
  double epsilon = 1e-3;

  /// ε for a mesh whose smallest determinant is d_min: √(10⁻⁶ + 0.04 min(d_min, 0)²).
  static FoldoverEnergy for_smallest(double d_min);

  static constexpr double volume_weight = 0.05;  ///< w

  /// What e is the sum of squares of: F / (√3 g^⅓) by columns, √(w / 2g) d and √(w / 2g).
  template <class T>
  Eigen::Matrix<T, 11, 1> residuals(const Eigen::Matrix<T, 3, 3>& F) const {
    using std::cbrt, std::sqrt;
    const T d = F.determinant(), g = (d + sqrt(d * d + epsilon * epsilon)) / 2.0;
    const T volume = sqrt(volume_weight / 2 / g);
    Eigen::Matrix<T, 11, 1> r;
    r << F.reshaped() / (std::sqrt(3.0) * cbrt(g)), volume * d, volume;
    return r;
  }

  using Gradient = Eigen::Matrix<double, 9, 1>;  ///< by F(row, column) at row + 3·column
  using Hessian = Eigen::Matrix<double, 9, 9>;

  double value(const Eigen::Matrix3d& F) const { return residuals(F).squaredNorm(); }
  Gradient gradient(const Eigen::Matrix3d& F) const;

  /// 2 JᵀJ with the residuals' Jacobian J: the Hessian of Gauss and Newton, positive semidefinite.
  /// It leads out of folds, where that without curvature ends.
  Hessian gauss_newton(const Eigen::Matrix3d& F) const;
  /// ∂²e/∂F∂F + curvature ∂e/∂F ⊗ ∂e/∂F without the eigenvectors along which it is not convex: by
  /// the singular values, as of every isotropic energy (Smith, de Goes and Kim, "Analytic
  /// eigensystems for isotropic distortion energies", ACM Trans. Graph. 38(1), 2019).
  Hessian convex_hessian(const Eigen::Matrix3d& F, double curvature = 0) const;
};

}  // namespace mammotwin
