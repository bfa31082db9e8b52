#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/element/surface_potential.h"

namespace mammotwin {

/// Positions in the plane z = 0 as a cubic polynomial of reference positions there.
class PlaneMap {
 public:
  PlaneMap() = default;  ///< the identity
  PlaneMap(const std::vector<Eigen::Vector3d>& X, const std::vector<Eigen::Vector3d>& x,
           const Eigen::Vector3d& centre);
  Eigen::Vector2d operator()(const Eigen::Vector3d& X) const;

 private:
  Eigen::Matrix<double, 10, 1> powers(const Eigen::Vector3d& X) const;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 2, 10> coefficients_ = Eigen::Matrix<double, 2, 10>::Zero();
  bool identity_ = true;
};

/// Rotation about z of the points that lie best on x after it (Procrustes), both about their means.
double roll_of(const std::vector<Eigen::Vector3d>& X, const std::vector<Eigen::Vector3d>& x);

/// Springs in the plane z = 0 towards a map of the face turned about a centre: k/2 |x − R(roll)
/// T(X)|². Where T is the face's own deformation less its roll they carry a couple and nothing
/// else.
class RollHold : public SurfacePotential {
 public:
  double k = 0.03;  ///< [kPa/mm]
  double roll = 0;  ///< [rad]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  PlaneMap map;

  /// Force on the tissue per reference area [kPa].
  Eigen::Vector2d force(const Eigen::Vector3d& X, const Eigen::Vector3d& x) const;

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
};

}  // namespace mammotwin
