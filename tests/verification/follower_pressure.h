#pragma once

#include "solver/element/surface_potential.h"

namespace mammotwin {

/// Pressure [kPa] on the deformed face, against its outward normal: energy = −p times the volume
/// that the face sweeps along `axis`, (e·x) e·(a₁ x a₂), per reference area.
///
/// A potential, and so symmetric, only where every rim of the loaded faces stays on a plane that
/// contains e or on the plane e·x = 0.
class FollowerPressure : public SurfacePotential {
 public:
  double pressure = 0;                              ///< [kPa], positive pushes into the body
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< e, unit

  Slots slots() const override { return kAll; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
};

}  // namespace mammotwin
