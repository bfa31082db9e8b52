#include "tests/verification/follower_pressure.h"

#include <Eigen/Geometry>

namespace mammotwin {

namespace {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d s;
  s << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return s;
}

}  // namespace

bool FollowerPressure::respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point,
                               int order, SurfaceResponse& response) const {
  const Eigen::Vector3d x = y.segment<3>(0), a1 = y.segment<3>(3), a2 = y.segment<3>(6);
  const Eigen::Vector3d reference = point.A1.cross(point.A2);
  // Pressure pushes inwards, so its potential is +p times the volume behind the face.
  const double scale = pressure * (reference.dot(point.normal) > 0 ? 1 : -1) / reference.norm();
  const double along = axis.dot(x);
  const Eigen::Vector3d d1 = a2.cross(axis), d2 = axis.cross(a1);  // ∂ e·(a₁ x a₂)/∂a₁, ∂a₂
  const double swept = axis.dot(a1.cross(a2));
  response.energy = scale * along * swept;
  response.gradient << scale * swept * axis, scale * along * d1, scale * along * d2;
  if (order < 2) return true;
  response.hessian.setZero();
  response.hessian.block<3, 3>(0, 3) = scale * axis * d1.transpose();
  response.hessian.block<3, 3>(0, 6) = scale * axis * d2.transpose();
  response.hessian.block<3, 3>(3, 6) = -scale * along * skew(axis);
  response.hessian.block<3, 3>(3, 0) = response.hessian.block<3, 3>(0, 3).transpose();
  response.hessian.block<3, 3>(6, 0) = response.hessian.block<3, 3>(0, 6).transpose();
  response.hessian.block<3, 3>(6, 3) = response.hessian.block<3, 3>(3, 6).transpose();
  return true;
}

}  // namespace mammotwin
