#include "solver/contact/plate.h"

#include <Eigen/Geometry>
#include <cmath>

#include "solver/contact/plate_mesh.h"

namespace mammotwin {

namespace {

using Eigen::Vector3d;

Gap flat(double gap, const Vector3d& normal) { return {gap, normal, Eigen::Matrix3d::Zero()}; }

Vector3d sideways(const Plate& plate) { return plate.normal.cross(plate.depth); }

Eigen::Matrix3d axes_of(const Plate& plate) {
  Eigen::Matrix3d axes;
  axes << plate.depth, sideways(plate), plate.normal;
  return axes;
}

/// How far a coordinate lies outside [low, high], with its sign.
double outside(double value, double low, double high) {
  return value < low ? value - low : value > high ? value - high : 0;
}

/// Cylinder of the rounding: gap = |v| − r for v = beyond · out + above · normal, with `out` a unit
/// vector in the face's plane.
Gap rounded(double beyond, double above, const Vector3d& out, const Plate& plate) {
  const Vector3d v = above * plate.normal + beyond * out;
  const double distance = v.norm();
  const Vector3d n = v / distance;
  const Vector3d t = (beyond * plate.normal - above * out) / distance;
  return {distance - plate.rounding, n, t * t.transpose() / distance};
}

/// Where the flat part has a corner, `out` turns with the point.
void add_corner(double beyond, const Vector3d& out, const Plate& plate, Gap& gap) {
  const Vector3d around = plate.normal.cross(out);
  const double slope = gap.normal.dot(out);  // ∂gap/∂beyond
  gap.hessian += slope / beyond * around * around.transpose();
}

Gap mesh_gap(const Plate& plate, const Vector3d& x) {
  const Eigen::Matrix3d axes = axes_of(plate);
  const Gap local = plate.mesh->gap(plate.to_local(x));
  return {local.gap, axes * local.normal, axes * local.hessian * axes.transpose()};
}

}  // namespace

Vector3d Plate::to_local(const Vector3d& x) const {
  return axes_of(*this).transpose() * (x - point);
}

Vector3d Plate::from_local(const Vector3d& x_local) const {
  return point + axes_of(*this) * x_local;
}

Gap Plate::gap(const Vector3d& x) const {
  if (mesh) return mesh_gap(*this, x);
  const double above = normal.dot(x - point);
  if (endless) return flat(above, normal);
  const double ahead = outside(depth.dot(x - point), 0, length);
  const double beside = outside(sideways(*this).dot(x - point), -half_width, half_width);
  if (ahead == 0 && beside == 0) return flat(above, normal);
  const bool corner = ahead != 0 && beside != 0;
  const double beyond = corner ? std::hypot(ahead, beside) : std::abs(ahead + beside);
  const Vector3d out = corner       ? ((ahead * depth + beside * sideways(*this)) / beyond).eval()
                       : ahead != 0 ? (ahead < 0 ? (-depth).eval() : depth)
                                    : (beside < 0 ? (-sideways(*this)).eval() : sideways(*this));
  const double above_centre = above + rounding;
  Gap gap =
      above_centre <= 0 ? flat(beyond - rounding, out) : rounded(beyond, above_centre, out, *this);
  if (corner) add_corner(beyond, out, *this, gap);
  return gap;
}

}  // namespace mammotwin
