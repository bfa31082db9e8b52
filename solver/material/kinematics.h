#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "solver/material/material.h"

namespace mammotwin {

/// The terms in J that every law shares.

/// −ln J, or infinity where J ≤ 0.
inline double minus_log_jacobian(const Eigen::Matrix3d& F) {
  const double J = F.determinant();
  return J > 0 ? -std::log(J) : std::numeric_limits<double>::infinity();
}

/// Cofactor matrix ∂J/∂F = J F⁻ᵀ; its columns are cross products, so it exists for J = 0 too.
inline Eigen::Matrix3d cofactor(const Eigen::Matrix3d& F) {
  Eigen::Matrix3d c;
  c.col(0) = F.col(1).cross(F.col(2));
  c.col(1) = F.col(2).cross(F.col(0));
  c.col(2) = F.col(0).cross(F.col(1));
  return c;
}

/// Adds s ∂²J/∂F², which is linear in F.
inline void add_cofactor_tangent(double s, const Eigen::Matrix3d& F, Material::Tangent& A) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      A(i + 3 * j, i1 + 3 * j1) += s * F(i2, j2);
      A(i + 3 * j, i2 + 3 * j2) += s * F(i1, j1);
      A(i + 3 * j, i1 + 3 * j2) -= s * F(i2, j1);
      A(i + 3 * j, i2 + 3 * j1) -= s * F(i1, j2);
    }
}

/// Adds s ∂(−F⁻ᵀ)/∂F, that is s F⁻¹_jk F⁻¹_li at row i+3j, column k+3l.
inline void add_inverse_tangent(double s, const Eigen::Matrix3d& F, Material::Tangent& A) {
  const Eigen::Matrix3d G = s * F.inverse();
  const Eigen::Matrix3d H = F.inverse();
  for (int l = 0; l < 3; ++l)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) A(i + 3 * j, k + 3 * l) += G(j, k) * H(l, i);
}

}  // namespace mammotwin
