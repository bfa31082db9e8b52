#include "solver/load/spring_bed.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace mammotwin {

SpringBed::SpringBed(double k) : k_(k) {
  if (!(std::isfinite(k) && k >= 0))
    throw std::invalid_argument("spring constant is " + std::to_string(k) +
                                "; expected at least 0 kPa/mm");
}

bool SpringBed::respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
                        SurfaceResponse& response) const {
  const Eigen::Vector3d u = y.head<3>() - point.X;
  response.energy = k_ / 2 * u.squaredNorm();
  response.gradient.head<3>() = k_ * u;
  if (order == 2) response.hessian.topLeftCorner<3, 3>() = k_ * Eigen::Matrix3d::Identity();
  return true;
}

Eigen::Matrix<double, 9, 9> SpringBed::reference_derivative(const Eigen::Matrix<double, 9, 1>&,
                                                            const SurfacePoint&) const {
  Eigen::Matrix<double, 9, 9> derivative = Eigen::Matrix<double, 9, 9>::Zero();
  derivative.topLeftCorner<3, 3>() = -k_ * Eigen::Matrix3d::Identity();
  return derivative;
}

}  // namespace mammotwin
