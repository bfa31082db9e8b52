#include "pipeline/evaluate/niftysim/roll_hold.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

namespace mammotwin {

using Eigen::Vector2d;
using Eigen::Vector3d;

Eigen::Matrix<double, 10, 1> PlaneMap::powers(const Vector3d& X) const {
  constexpr double scale = 50;  // [mm]: keeps the normal equations well scaled
  const double a = (X.x() - centre_.x()) / scale, b = (X.y() - centre_.y()) / scale;
  Eigen::Matrix<double, 10, 1> p;
  p << 1, a, b, a * a, a * b, b * b, a * a * a, a * a * b, a * b * b, b * b * b;
  return p;
}

PlaneMap::PlaneMap(const std::vector<Vector3d>& X, const std::vector<Vector3d>& x,
                   const Vector3d& centre)
    : centre_(centre), identity_(false) {
  Eigen::Matrix<double, 10, 10> a = Eigen::Matrix<double, 10, 10>::Zero();
  Eigen::Matrix<double, 10, 2> b = Eigen::Matrix<double, 10, 2>::Zero();
  for (std::size_t n = 0; n < X.size(); ++n) {
    const auto p = powers(X[n]);
    a += p * p.transpose();
    b += p * x[n].head<2>().transpose();
  }
  coefficients_ = a.ldlt().solve(b).transpose();
}

Vector2d PlaneMap::operator()(const Vector3d& X) const {
  return identity_ ? Vector2d(X.head<2>()) : Vector2d(coefficients_ * powers(X));
}

double roll_of(const std::vector<Vector3d>& X, const std::vector<Vector3d>& x) {
  Vector3d mean_X = Vector3d::Zero(), mean_x = Vector3d::Zero();
  for (std::size_t n = 0; n < X.size(); ++n) mean_X += X[n] / X.size(), mean_x += x[n] / X.size();
  double along = 0, across = 0;
  for (std::size_t n = 0; n < X.size(); ++n) {
    const Vector2d A = (X[n] - mean_X).head<2>(), a = (x[n] - mean_x).head<2>();
    along += A.dot(a), across += A.x() * a.y() - A.y() * a.x();
  }
  return std::atan2(across, along);
}

Vector2d RollHold::force(const Vector3d& X, const Vector3d& x) const {
  const Vector2d c = centre.head<2>();
  return k * (c + Eigen::Rotation2Dd(roll) * (map(X) - c) - x.head<2>());
}

bool RollHold::respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
                       SurfaceResponse& response) const {
  const Vector2d pull = -force(point.X, y.head<3>());
  response.energy = pull.squaredNorm() / (2 * k);
  response.gradient.head<3>() << pull, 0;
  if (order == 2)
    response.hessian.topLeftCorner<3, 3>() = Vector3d(k, k, 0).asDiagonal().toDenseMatrix();
  return true;
}

}  // namespace mammotwin
