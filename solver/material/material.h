#pragma once

#include <Eigen/Core>

namespace mammotwin {

/// The displacement's part of a hyperelastic law: stored energy per reference volume W(F) [kPa].
///
/// Every law is stress-free at rest without a pressure, so W contains a logarithm of J. The
/// pressure's part, p (J − 1) − p²/(2κ), is the element's (element/solid_element.h) and makes the
/// material incompressible. A new law passes tests/solver/material/material_laws.h before its own
/// tests.
class Material {
 public:
  /// ∂P/∂F with F and P unrolled column by column: row i+3j, column k+3l is ∂P_ij/∂F_kl.
  using Tangent = Eigen::Matrix<double, 9, 9>;

  virtual ~Material() = default;

  /// W [kPa]. Infinite for J ≤ 0, so a line search rejects an inverted element.
  virtual double energy(const Eigen::Matrix3d& F) const = 0;

  /// First Piola-Kirchhoff stress P = ∂W/∂F [kPa]. Requires J > 0.
  virtual Eigen::Matrix3d stress(const Eigen::Matrix3d& F) const = 0;

  /// ∂P/∂F [kPa], symmetric; not positive definite in general. Requires J > 0.
  virtual Tangent tangent(const Eigen::Matrix3d& F) const = 0;

  /// μ at rest [kPa].
  virtual double shear_modulus() const = 0;
};

}  // namespace mammotwin
