#include "solver/load/spring_bed.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace mammotwin {

SpringBed::SpringBed(double k, double reach) : k_(k), reach_(reach) {
  if (!(std::isfinite(k) && k >= 0))
    throw std::invalid_argument("spring constant is " + std::to_string(k) +
                                "; expected at least 0 kPa/mm");
  if (!(reach > 0))
    throw std::invalid_argument("reach of the springs is " + std::to_string(reach) +
                                "; expected more than 0 mm");
}

Eigen::Matrix3d SpringBed::stiffness(const Eigen::Vector3d& u) const {
  const Eigen::Vector3d in_reaches = u / reach_;
  return k_ * std::exp(in_reaches.squaredNorm()) *
         (Eigen::Matrix3d::Identity() + 2 * in_reaches * in_reaches.transpose());
}

bool SpringBed::respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
                        SurfaceResponse& response) const {
  const Eigen::Vector3d u = y.head<3>() - point.X;
  const double far = (u / reach_).squaredNorm();
  response.energy =
      std::isinf(reach_) ? k_ / 2 * u.squaredNorm() : k_ / 2 * reach_ * reach_ * std::expm1(far);
  response.gradient.head<3>() = k_ * std::exp(far) * u;
  if (order == 2) response.hessian.topLeftCorner<3, 3>() = stiffness(u);
  return true;
}

Eigen::Matrix<double, 9, 9> SpringBed::reference_derivative(const Eigen::Matrix<double, 9, 1>& y,
                                                            const SurfacePoint& point) const {
  Eigen::Matrix<double, 9, 9> derivative = Eigen::Matrix<double, 9, 9>::Zero();
  derivative.topLeftCorner<3, 3>() = -stiffness(y.head<3>() - point.X);
  return derivative;
}

}  // namespace mammotwin
