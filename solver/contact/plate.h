#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>

namespace mammotwin {

class PlateMesh;

/// Distance to a rigid surface with its first two derivatives. gap > 0 apart [mm].
struct Gap {
  double gap;
  Eigen::Vector3d normal;   ///< ∂gap/∂x, away from the rigid body
  Eigen::Matrix3d hessian;  ///< ∂²gap/∂x² [1/mm]
};

/// Rigid compression plate: a flat rectangle whose straight edges are rounded and go on as walls
/// away from the tissue. Endless sideways and to the front unless `half_width` and `length` say
/// otherwise.
///
///          tissue                        depth → (towards the nipple)
///        (      ________ face ________
///     wall |  r (                         ↑ normal points from the plate into the tissue
///
/// Points that are deeper inside than the rounding's radius are pushed out through the face if
/// they are in front of the rounding's centre, through the wall if behind.
struct Plate {
  Eigen::Vector3d point;   ///< a point of the flat face where the rounding begins [mm]
  Eigen::Vector3d normal;  ///< unit, into the tissue
  Eigen::Vector3d depth;   ///< unit, from the edge to the front, orthogonal to normal
  double rounding = 0;     ///< radius [mm]; infinite flat face if `endless`
  bool endless = false;    ///< no edge: a half space
  double half_width = std::numeric_limits<double>::infinity();  ///< of the flat part, sideways [mm]
  double length = std::numeric_limits<double>::infinity();  ///< of the flat part, along depth [mm]
  std::shared_ptr<const PlateMesh> mesh = nullptr;  ///< instead of all this: facets about `point`

  Gap gap(const Eigen::Vector3d& x) const;

  /// Coordinates in a frame that moves with the plate: along depth, sideways, along normal [mm].
  Eigen::Vector3d to_local(const Eigen::Vector3d& x) const;
  Eigen::Vector3d from_local(const Eigen::Vector3d& x_local) const;
};

}  // namespace mammotwin
