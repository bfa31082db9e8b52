#pragma once

#include <array>
#include <memory>

#include "solver/material/material.h"

namespace mammotwin {

/// How the tissues in one quadrature point's cell share its deformation.
///
/// `arithmetic` (Voigt: both strain alike) bounds the stiffness from above, `harmonic` (Reuss:
/// both carry the same stress) from below; `geometric` lies between and is exact for a random
/// two-phase medium in two dimensions (Keller 1964). Which is nearest to a resolved breast is
/// measured in solver/README.md.
enum class Mixing { arithmetic, geometric, harmonic };

/// Fractions f of n tissues with shear moduli mu [kPa] -> shear modulus of the mixture [kPa].
double mixed_modulus(Mixing mixing, const std::array<double, 3>& fractions,
                     const std::array<double, 3>& shear_moduli);

/// W = s Σ fₜ Wₜ: the tissues' laws in parallel, scaled by s so that the shear modulus at rest is
/// the mixing rule's. The laws must outlive the mixture.
class Mixture : public Material {
 public:
  using Laws = std::array<std::shared_ptr<const Material>, 3>;

  /// Fractions in [0, 1] that sum to 1 within 1e-6; else std::invalid_argument.
  Mixture(Mixing mixing, const std::array<double, 3>& fractions, const Laws& laws);

  double energy(const Eigen::Matrix3d& F) const override;
  Eigen::Matrix3d stress(const Eigen::Matrix3d& F) const override;
  Tangent tangent(const Eigen::Matrix3d& F) const override;
  double shear_modulus() const override;

 private:
  std::array<double, 3> weights_;
  Laws laws_;
};

/// The mixture as one law: a single tissue's own where there is only one, one neo-Hookean law where
/// all tissues are neo-Hookean (the same W, cheaper), else a Mixture.
std::shared_ptr<const Material> mix(Mixing mixing, const std::array<double, 3>& fractions,
                                    const Mixture::Laws& laws);

}  // namespace mammotwin
