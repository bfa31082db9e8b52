#pragma once

#include <limits>

#include "solver/element/surface_potential.h"

namespace mammotwin {

/// Springs from every point of a face to its reference position, linear or stiffening:
///
///     energy = k/2 s² (exp(|x − X|²/s²) − 1),   k/2 |x − X|² for s → ∞
///
/// so that a point gives way until about s and hardly beyond 2 s.
///
/// On a chest wall, whose normal displacement is held by a WallHold, only the sliding is left
/// for them to resist; on cut faces they stand for the tissue that goes on behind the cut.
class SpringBed : public SurfacePotential {
 public:
  /// k >= 0 [kPa/mm], reach s > 0 [mm]; else std::invalid_argument.
  explicit SpringBed(double k, double reach = std::numeric_limits<double>::infinity());

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
  Eigen::Matrix<double, 9, 9> reference_derivative(const Eigen::Matrix<double, 9, 1>& y,
                                                   const SurfacePoint& point) const override;

 private:
  Eigen::Matrix3d stiffness(const Eigen::Vector3d& u) const;
  double k_, reach_;
};

}  // namespace mammotwin
