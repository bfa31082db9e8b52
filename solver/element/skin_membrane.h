#pragma once

#include "solver/element/surface_potential.h"

namespace mammotwin {

/// Skin as an incompressible membrane on the skin faces, in plane stress:
///
///     energy = h c₁/b (exp(b (I₁ − 3)) − 1),   I₁ = A^αβ a_αβ + det A/det a
///
/// with a_αβ = a_α·a_β, A_αβ = A_α·A_β: the three-dimensional law with the thickness stretch
/// eliminated by J = 1 (Holzapfel, Nonlinear Solid Mechanics, section 6.5, for sheets in plane
/// stress; the exponential: Demiray 1972, material/exponential.h). b = 0 is neo-Hookean,
/// h c₁ (I₁ − 3). Limits: no bending stiffness; isotropic; thickness is uniform.
class SkinMembrane : public SurfacePotential {
 public:
  /// c1 [kPa] and thickness h [mm], both > 0, b >= 0 [-]; else std::invalid_argument.
  SkinMembrane(double c1, double thickness, double b = 0);

  Slots slots() const override { return kTangents; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
  Eigen::Matrix<double, 9, 9> reference_derivative(const Eigen::Matrix<double, 9, 1>& y,
                                                   const SurfacePoint& point) const override;

 private:
  double stiffness_;  ///< h c₁ [kPa mm]
  double b_;
};

}  // namespace mammotwin
