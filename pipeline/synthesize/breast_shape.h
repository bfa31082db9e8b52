#pragma once

#include <Eigen/Core>

#include "pipeline/synthesize/options.h"

namespace mammotwin {

/// Outline of one hanging breast: in every coronal plane an ellipse, that goes straight forward
/// from the chest wall, closes to a dome, and drifts with depth towards the feet and the side.
/// LPS [mm].
struct BreastShape {
  double outward = 1;  ///< +1 left, -1 right: sign of x away from the midline
  Eigen::Vector3d base = Eigen::Vector3d::Zero();  ///< middle of the base on the chest wall
  double width = 50, height = 60, length = 80;     ///< half right-left, half head-feet, depth
  double turn = 0, sag = 0;  ///< drift of the tip outward and towards the feet
  double roundness = 2.4;    ///< exponent of the dome; 2 is an ellipsoid, more is blunter
  double neck = 0.05;        ///< narrowing at the base, a fraction

  /// Signed distance to the outline [mm], true to first order near it; negative inside.
  double distance(const Eigen::Vector3d& x) const;
  /// 0 at the base, 1 at the tip.
  double depth_fraction(const Eigen::Vector3d& x) const { return (base.y() - x.y()) / length; }
  /// The axis of the breast at a depth fraction.
  Eigen::Vector3d axis(double depth_fraction) const;
};

/// A rounded peg through the outline near the tip: the papilla, which is skin, and under the skin
/// the ducts that meet there.
struct Nipple {
  Eigen::Vector3d root = Eigen::Vector3d::Zero();  ///< on the outline
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitY();
  double radius = 5, height = 6;  ///< [mm]

  double distance(const Eigen::Vector3d& x) const;
  Eigen::Vector3d tip() const { return root + height * direction; }
};

}  // namespace mammotwin
