#pragma once

#include "solver/material/material.h"

namespace mammotwin {

/// Exponentially stiffening solid:
///
///     W(F) = c₁/b (exp(b (I₁ − 3)) − 1) − 2 c₁ ln J
///
/// Source: Demiray 1972 (J. Biomech. 5:309); the logarithm makes rest stress-free. μ = 2 c₁ at
/// rest; b → 0 is neo-Hookean. Limits: isotropic; the exponent overflows for b (I₁ − 3) > 700,
/// where the energy is infinite and a step is rejected.
class Exponential : public Material {
 public:
  /// c₁ > 0 [kPa] and b > 0 [-]; else std::invalid_argument.
  Exponential(double c1, double b);

  double energy(const Eigen::Matrix3d& F) const override;
  Eigen::Matrix3d stress(const Eigen::Matrix3d& F) const override;
  Tangent tangent(const Eigen::Matrix3d& F) const override;
  double shear_modulus() const override { return 2 * c1_; }

 private:
  double growth(const Eigen::Matrix3d& F) const;
  double c1_, b_;
};

}  // namespace mammotwin
