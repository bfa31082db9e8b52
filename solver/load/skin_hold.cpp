#include "solver/load/skin_hold.h"

namespace mammotwin {

void SkinHold::remember(const SurfacePoint& point, const Eigen::Vector3d& imaged, double k) {
  if (static_cast<int>(springs_.size()) <= point.index) springs_.resize(point.index + 1);
  springs_[point.index] = {imaged, k};
}

bool SkinHold::respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
                       SurfaceResponse& response) const {
  const Spring& spring = springs_[point.index];
  const double k = share_ * spring.k;
  if (k == 0) return false;
  const Eigen::Vector3d u = y.head<3>() - spring.imaged;
  response.energy = k / 2 * u.squaredNorm();
  response.gradient.head<3>() = k * u;
  if (order == 2) response.hessian.topLeftCorner<3, 3>() = k * Eigen::Matrix3d::Identity();
  return true;
}

/// Where it holds is known of the imaged shape, not of the reference.
Eigen::Matrix<double, 9, 9> SkinHold::reference_derivative(const Eigen::Matrix<double, 9, 1>&,
                                                           const SurfacePoint&) const {
  return Eigen::Matrix<double, 9, 9>::Zero();
}

}  // namespace mammotwin
