#pragma once

#include "solver/element/surface_potential.h"

namespace mammotwin {

/// Springs from every point of a face to its reference position: energy = k/2 |x − X|².
///
/// On a chest wall, whose normal displacement is held by a WallContact, only the sliding is left
/// for them to resist; on cut faces they stand for the tissue that goes on behind the cut.
class SpringBed : public SurfacePotential {
 public:
  /// k >= 0 [kPa/mm]; else std::invalid_argument.
  explicit SpringBed(double k);

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
  Eigen::Matrix<double, 9, 9> reference_derivative(const Eigen::Matrix<double, 9, 1>& y,
                                                   const SurfacePoint& point) const override;

 private:
  double k_;
};

}  // namespace mammotwin
