#include "pipeline/evaluate/niftysim/round_skin.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace mammotwin {

using Eigen::Vector3d;

Eigen::VectorXd RoundSkin::harmonics(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d d = direction.normalized();
  const double polar = std::acos(std::clamp(d.z(), -1.0, 1.0)), azimuth = std::atan2(d.y(), d.x());
  Eigen::VectorXd y((degree_ + 1) * (degree_ + 1));
  for (int l = 0, n = 0; l <= degree_; ++l)
    for (int m = -l; m <= l; ++m)
      y[n++] = std::sph_legendre(l, std::abs(m), polar) *
               (m < 0 ? std::sin(-m * azimuth) : std::cos(m * azimuth));
  return y;
}

RoundSkin::RoundSkin(const Eigen::Vector3d& centre, const std::vector<Eigen::Vector3d>& points,
                     int degree, double smoothing)
    : centre_(centre), degree_(degree) {
  const int size = (degree + 1) * (degree + 1);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
  for (const auto& x : points) {
    const Eigen::VectorXd y = harmonics(x - centre);
    a += y * y.transpose() / points.size();
    b += y * (x - centre).norm() / points.size();
  }
  for (int l = 0, n = 0; l <= degree; ++l)
    for (int m = -l; m <= l; ++m, ++n) a(n, n) += smoothing * l * l * (l + 1) * (l + 1);
  coefficients_ = a.ldlt().solve(b);
  for (const auto& x : points)
    rms_ += std::pow((x - centre).norm() - radius(x - centre), 2) / points.size();
  rms_ = std::sqrt(rms_);
}

double RoundSkin::radius(const Eigen::Vector3d& direction) const {
  return coefficients_.dot(harmonics(direction));
}

MeshFile fit_half_ball(const RoundSkin& skin, const HalfBallElements& elements) {
  const Vector3d half(skin.radius(Vector3d::UnitX()), skin.radius(Vector3d::UnitY()),
                      skin.radius(Vector3d::UnitZ()));
  return half_ball_mesh(
      [&](const Vector3d& p) -> Vector3d {
        const double r2 = p.squaredNorm();
        const Vector3d inner = half.cwiseProduct(p);
        if (r2 == 0) return skin.centre();
        return skin.centre() + (1 - r2) * inner + r2 * skin.radius(p) * p;
      },
      elements);
}

}  // namespace mammotwin
