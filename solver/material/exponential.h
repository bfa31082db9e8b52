#pragma once

#include <limits>

#include "solver/material/material.h"

namespace mammotwin {

/// Exponentially stiffening solid, whose stiffening may end:
///
///     W(F) = c₁ m/b ln(1 + (exp(b (I₁ − 3)) − 1)/m) − 2 c₁ ln J
///
/// Source: Demiray 1972 (J. Biomech. 5:309) is m = ∞; with m the stress over F grows from c₁ as a
/// logistic to m c₁, as tissue's does whose collagen is taut (Fung, Biomechanics, 1993: the toe of
/// the curve and its linear part). The last term makes rest stress-free. μ = 2 c₁ at rest; b → 0 or
/// m → 1 is neo-Hookean. Limits: isotropic; with m = ∞ the exponent overflows for b (I₁ − 3) > 700,
/// where the energy is infinite and a step is rejected.
class Exponential : public Material {
 public:
  /// c₁ > 0 [kPa], b > 0 and m >= 1 [-]; else std::invalid_argument.
  Exponential(double c1, double b, double most = std::numeric_limits<double>::infinity());

  double energy(const Eigen::Matrix3d& F) const override;
  Eigen::Matrix3d stress(const Eigen::Matrix3d& F) const override;
  Tangent tangent(const Eigen::Matrix3d& F) const override;
  double shear_modulus() const override { return 2 * c1_; }

 private:
  double growth(const Eigen::Matrix3d& F) const;
  double c1_, b_;
  double limit_;  ///< 1/m
};

}  // namespace mammotwin
