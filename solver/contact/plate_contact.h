#pragma once

#include "solver/contact/plate.h"
#include "solver/element/surface_potential.h"

#include <limits>
#include <vector>

namespace mammotwin {

/// Frictionless penalty contact with rigid plates (paper, eq. 8), per reference area:
///
///     energy = Σ_plates t²/(2ε),   pressure t = ⟨−ε gap⟩
///
/// with the exact tangent (normal and curvature of the plate), but for one thing: pressures above
/// `curvature_pressure` count as that in the curvature's part. Far from equilibrium, just after ε
/// was raised, an edge's curvature would otherwise make the tangent indefinite; tissue in
/// equilibrium presses with a few shear moduli. The driver moves the plates and continues ε
/// (penalty_continuation.h).
class PlateContact : public SurfacePotential {
 public:
  std::vector<Plate> plates;
  double penalty = 1;  ///< ε [kPa/mm]
  int points1d = 5;    ///< Gauss points a side on the faces in contact
  double curvature_pressure = std::numeric_limits<double>::infinity();  ///< [kPa]

  double pressure(double gap) const { return gap < 0 ? -penalty * gap : 0; }  ///< t [kPa]

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
};

}  // namespace mammotwin
