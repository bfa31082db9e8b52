#pragma once

#include <Eigen/Core>
#include <vector>

#include "pipeline/evaluate/niftysim/half_ball_mesh.h"

namespace mammotwin {

/// Skin as a distance from a centre in every direction: real spherical harmonics up to a degree,
/// fitted by least squares to points on it. For a breast that every ray from the centre leaves
/// once.
class RoundSkin {
 public:
  /// `smoothing` is the weight of the squared Laplacian on the sphere against the mean squared
  /// residual; it decides where there are no points (behind the chest wall).
  RoundSkin(const Eigen::Vector3d& centre, const std::vector<Eigen::Vector3d>& points,
            int degree = 12, double smoothing = 1e-6);

  const Eigen::Vector3d& centre() const { return centre_; }
  double radius(const Eigen::Vector3d& direction) const;  ///< [mm]; direction of any length
  double rms() const { return rms_; }                     ///< of the points, along the rays [mm]

 private:
  Eigen::VectorXd harmonics(const Eigen::Vector3d& direction) const;

  Eigen::Vector3d centre_;
  int degree_;
  Eigen::VectorXd coefficients_;
  double rms_ = 0;
};

/// The half ball on such a breast, whose chest wall is the plane z = 0 through the centre: near the
/// centre an ellipsoid's map, on the skin the skin.
MeshFile fit_half_ball(const RoundSkin& skin, const HalfBallElements& elements);

}  // namespace mammotwin
