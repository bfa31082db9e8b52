#pragma once

#include "solver/element/surface_potential.h"

namespace mammotwin {

/// Pressure [kPa] on the deformed face, against its outward normal: energy = −p times the volume
/// that the face sweeps, x · (a₁ x a₂)/3, per reference area.
///
/// A potential, and so symmetric, only where the loaded faces close a volume or end on planes
/// that they cannot leave and that pass through the origin.
class FollowerPressure : public SurfacePotential {
 public:
  double pressure = 0;  ///< [kPa], positive pushes into the body

  Slots slots() const override { return kAll; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
};

}  // namespace mammotwin
