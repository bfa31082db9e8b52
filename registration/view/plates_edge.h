#pragma once

#include <Eigen/Core>

namespace mammotwin {

/// Where the plates' rear edge lies on the detector once the breast is turned on it and shifted: in
/// the detector's plane (u, v) [mm].
struct PlatesEdge {
  double turn_deg = 0;                                 ///< from depth towards lateral
  Eigen::Vector2d shift_mm = Eigen::Vector2d::Zero();  ///< in depth and lateral

  /// How far a place lies before it; negative: behind.
  double before_mm(const Eigen::Vector2d& place) const;
};

}  // namespace mammotwin
