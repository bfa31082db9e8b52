#pragma once

#include <vector>

#include "solver/contact/plate.h"
#include "solver/element/surface_potential.h"
#include "solver/newton/following.h"

namespace mammotwin {

/// Frictionless penalty contact with rigid plates (paper, eq. 8), per reference area:
///
///     energy = Σ_plates t²/(2ε),   pressure t = ⟨−ε gap⟩
///
/// with the exact tangent (normal and curvature of the plate) unless `with_curvature` is off. Far
/// from equilibrium, just after ε was raised, t is the violation's and not the tissue's, and its
/// product with an edge's curvature makes the tangent indefinite at J = 1. The driver moves the
/// plates and continues ε (penalty_continuation.h).
class PlateContact : public SurfacePotential {
 public:
  std::vector<Plate> plates;
  double penalty = 1;          ///< ε [kPa/mm]
  int points1d = 5;            ///< Gauss points a side on the faces in contact
  bool with_curvature = true;  ///< t ∂²gap/∂x² in the tangent
  Following follow;            ///< friction's; empty: no friction, or frozen

  double pressure(double gap) const { return gap < 0 ? -penalty * gap : 0; }  ///< t [kPa]

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
};

}  // namespace mammotwin
