#pragma once

#include "solver/material/material.h"

namespace mammotwin {

/// Mooney-Rivlin solid:
///
///     W(F) = c₁ (I₁ − 3) + c₂ (I₂ − 3) − 2 (c₁ + 2 c₂) ln J
///
/// I₁, I₂ invariants of C (paper, eq. 3). Source: Mooney 1940, Rivlin 1948; the logarithm makes
/// rest stress-free. μ = 2 (c₁ + c₂). Limits: isotropic; c₂ matters in biaxial stretch, hardly in
/// uniaxial compression.
class MooneyRivlin : public Material {
 public:
  /// c₁ > 0 and c₂ >= 0 [kPa]; else std::invalid_argument.
  MooneyRivlin(double c1, double c2);

  double energy(const Eigen::Matrix3d& F) const override;
  Eigen::Matrix3d stress(const Eigen::Matrix3d& F) const override;
  Tangent tangent(const Eigen::Matrix3d& F) const override;
  double shear_modulus() const override { return 2 * (c1_ + c2_); }

 private:
  double c1_, c2_;
};

}  // namespace mammotwin
