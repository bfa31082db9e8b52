#pragma once

#include "solver/contact/plate.h"
#include "solver/element/surface_potential.h"

#include <vector>

namespace mammotwin {

/// Frictionless penalty contact with rigid plates (paper, eq. 8), per reference area:
///
///     energy = Σ_plates ε/2 ⟨−gap⟩²
///
/// with the exact tangent (normal and curvature of the plate). The driver moves the plates and
/// continues ε (solver/load/load_stepping.h).
class PlateContact : public SurfacePotential {
 public:
  std::vector<Plate> plates;
  double penalty = 1;  ///< ε [kPa/mm]

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
};

}  // namespace mammotwin
