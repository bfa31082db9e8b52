#pragma once

#include <Eigen/Core>

namespace mammotwin {

/// Distance to a rigid surface with its first two derivatives. gap > 0 apart [mm].
struct Gap {
  double gap;
  Eigen::Vector3d normal;   ///< ∂gap/∂x, away from the rigid body
  Eigen::Matrix3d hessian;  ///< ∂²gap/∂x² [1/mm]
};

/// Rigid compression plate: a flat face, endless sideways and to the front, whose straight rear
/// edge is rounded and goes on as a wall away from the tissue.
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

  Gap gap(const Eigen::Vector3d& x) const;

  /// Coordinates in a frame that moves with the plate: along depth, sideways, along normal [mm].
  Eigen::Vector3d to_local(const Eigen::Vector3d& x) const;
  Eigen::Vector3d from_local(const Eigen::Vector3d& x_local) const;
};

}  // namespace mammotwin
