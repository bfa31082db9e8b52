#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/element/surface_potential.h"

namespace mammotwin {

/// Skin that lay on something rigid when it was imaged, and stuck to it: springs to where it was
/// imaged,
///
///     energy = k/2 |x − x_imaged|²
///
/// which exert nothing on the imaged shape. What pressed there is a load of its own
/// (BreastProblem::skin_forces).
class SkinHold : public SurfacePotential {
 public:
  /// k >= 0 [kPa/mm].
  void remember(const SurfacePoint& point, const Eigen::Vector3d& imaged, double k);

  /// Of all springs, how much is there; 1 at first.
  void set_share(double share) { share_ = share; }

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
  Eigen::Matrix<double, 9, 9> reference_derivative(const Eigen::Matrix<double, 9, 1>& y,
                                                   const SurfacePoint& point) const override;

 private:
  struct Spring {
    Eigen::Vector3d imaged = Eigen::Vector3d::Zero();
    double k = 0;
  };
  double share_ = 1;
  std::vector<Spring> springs_;  ///< by surface point
};

}  // namespace mammotwin
