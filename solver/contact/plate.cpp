#include "solver/contact/plate.h"

#include <Eigen/Geometry>

namespace mammotwin {

namespace {

Gap flat(double gap, const Eigen::Vector3d& normal) {
  return {gap, normal, Eigen::Matrix3d::Zero()};
}

/// Cylinder of the rounding: gap = |v| − r for v = behind · (−depth) + above · normal.
Gap rounded(double behind, double above, const Plate& plate) {
  const Eigen::Vector3d v = above * plate.normal - behind * plate.depth;
  const double distance = v.norm();
  const Eigen::Vector3d n = v / distance;
  const Eigen::Vector3d t = (above * plate.depth + behind * plate.normal) / distance;
  return {distance - plate.rounding, n, t * t.transpose() / distance};
}

Eigen::Matrix3d axes_of(const Plate& plate) {
  Eigen::Matrix3d axes;
  axes << plate.depth, plate.normal.cross(plate.depth), plate.normal;
  return axes;
}

}  // namespace

Eigen::Vector3d Plate::to_local(const Eigen::Vector3d& x) const {
  return axes_of(*this).transpose() * (x - point);
}

Eigen::Vector3d Plate::from_local(const Eigen::Vector3d& x_local) const {
  return point + axes_of(*this) * x_local;
}

Gap Plate::gap(const Eigen::Vector3d& x) const {
  const double above = normal.dot(x - point);
  const double behind = -depth.dot(x - point);
  if (endless || behind <= 0) return flat(above, normal);
  const double above_centre = above + rounding;
  if (above_centre <= 0) return flat(behind - rounding, -depth);
  return rounded(behind, above_centre, *this);
}

}  // namespace mammotwin
