#pragma once

#include <algorithm>
#include <vector>

#include "solver/contact/plate.h"
#include "solver/element/surface_potential.h"
#include "solver/newton/following.h"

namespace mammotwin {

/// Frictionless contact with rigid plates, a penalty (paper, eq. 8), per reference area:
///
///     energy = Σ_plates t²/(2ε),   pressure t = ⟨−ε gap⟩
///
/// with the exact tangent (normal and curvature of the plate). The driver moves the plates and
/// continues ε (penalty_continuation.h).
class PlateContact : public SurfacePotential {
 public:
  std::vector<Plate> plates;
  double penalty = 1;  ///< ε [kPa/mm]
  int points1d = 5;    ///< Gauss points a side on the faces in contact
  Following follow;    ///< friction's; empty: no friction, or frozen

  /// t [kPa].
  double pressure(double gap) const { return std::max(0.0, -penalty * gap); }

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
};

}  // namespace mammotwin
