#pragma once

#include "solver/material/material.h"

namespace mammotwin {

/// Neo-Hookean solid:
///
///     W(F) = c₁ (tr FᵀF − 3 − 2 ln J),    J = det F
///
/// Source: paper, eq. 9, which this equals at J = 1; the logarithm makes rest stress-free.
/// Limits: isotropic; no stiffening, so it underestimates stress beyond about 30 % strain.
class NeoHookean : public Material {
 public:
  /// c₁ > 0 [kPa], half the shear modulus at rest; else std::invalid_argument.
  explicit NeoHookean(double c1);

  double energy(const Eigen::Matrix3d& F) const override;
  Eigen::Matrix3d stress(const Eigen::Matrix3d& F) const override;
  Tangent tangent(const Eigen::Matrix3d& F) const override;
  double shear_modulus() const override { return 2 * c1_; }

 private:
  double c1_;
};

}  // namespace mammotwin
