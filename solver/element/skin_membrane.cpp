#include "solver/element/skin_membrane.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "solver/material/positive_modulus.h"

namespace mammotwin {

namespace {

using Tangents = Eigen::Matrix<double, 3, 2>;

/// ∂bᵅ/∂a_β for the contravariant base bᵅ = a^αβ a_β: −bᵝ (bᵅ)ᵀ + a^αβ n nᵀ.
Eigen::Matrix3d dual_derivative(const Tangents& b, const Eigen::Matrix2d& inverse_metric,
                                const Eigen::Vector3d& n, int alpha, int beta) {
  return -b.col(beta) * b.col(alpha).transpose() + inverse_metric(alpha, beta) * n * n.transpose();
}

}  // namespace

SkinMembrane::SkinMembrane(double c1, double thickness, double b)
    : stiffness_(positive_modulus("c1 (skin)", c1) *
                 positive_modulus("thickness (skin)", thickness)),
      b_(b) {
  if (!(std::isfinite(b) && b >= 0))
    throw std::invalid_argument("stiffening of the skin is " + std::to_string(b) +
                                "; expected at least 0");
}

bool SkinMembrane::respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point,
                           int order, SurfaceResponse& response) const {
  Tangents a, A;
  a << y.segment<3>(3), y.segment<3>(6);
  A << point.A1, point.A2;
  const Eigen::Matrix2d metric = a.transpose() * a, reference = A.transpose() * A;
  const Eigen::Matrix2d G = reference.inverse();
  const double squared_area = metric.determinant();
  if (!(squared_area > 0)) {
    response.energy = std::numeric_limits<double>::infinity();
    response.gradient.setZero();
    response.hessian.setZero();
    return true;
  }
  const double squared_thinning = reference.determinant() / squared_area;
  const double strain = G.cwiseProduct(metric).sum() + squared_thinning - 3;
  const double growth = std::exp(b_ * strain);
  response.energy = stiffness_ * (b_ > 0 ? std::expm1(b_ * strain) / b_ : strain);
  if (order == 0) return true;
  const Eigen::Matrix2d inverse_metric = metric.inverse();
  const Tangents b = a * inverse_metric;
  const Tangents force = 2 * stiffness_ * growth * (a * G - squared_thinning * b);
  response.gradient.tail<6>() = force.reshaped();
  if (order == 1) return true;
  const Eigen::Vector3d n = a.col(0).cross(a.col(1)).normalized();
  for (int alpha = 0; alpha < 2; ++alpha)
    for (int beta = 0; beta < 2; ++beta)
      response.hessian.block<3, 3>(3 + 3 * alpha, 3 + 3 * beta) =
          2 * stiffness_ * growth *
          (G(alpha, beta) * Eigen::Matrix3d::Identity() +
           squared_thinning * (2 * b.col(alpha) * b.col(beta).transpose() -
                               dual_derivative(b, inverse_metric, n, alpha, beta)));
  const auto pull = force.reshaped();
  response.hessian.bottomRightCorner<6, 6>() +=
      b_ / (stiffness_ * growth) * pull * pull.transpose();
  return true;
}

// With B = A⁻¹ (reference metric) and δ its change: δB = −B δ B, and det A/det a changes by tr(B
// δ).
Eigen::Matrix<double, 9, 9> SkinMembrane::reference_derivative(const Eigen::Matrix<double, 9, 1>& y,
                                                               const SurfacePoint& point) const {
  Tangents a, A;
  a << y.segment<3>(3), y.segment<3>(6);
  A << point.A1, point.A2;
  const Eigen::Matrix2d metric = a.transpose() * a, reference = A.transpose() * A;
  const Eigen::Matrix2d G = reference.inverse(), inverse_metric = metric.inverse();
  const double squared_thinning = reference.determinant() / metric.determinant();
  const double growth = std::exp(b_ * (G.cwiseProduct(metric).sum() + squared_thinning - 3));
  const Tangents pull = 2 * stiffness_ * growth * (a * G - squared_thinning * a * inverse_metric);
  Eigen::Matrix<double, 9, 9> derivative = Eigen::Matrix<double, 9, 9>::Zero();
  for (int beta = 0; beta < 2; ++beta)
    for (int i = 0; i < 3; ++i) {
      Tangents dA = Tangents::Zero();
      dA(i, beta) = 1;
      const Eigen::Matrix2d change = dA.transpose() * A + A.transpose() * dA;
      const double trace = G.cwiseProduct(change).sum();
      const Tangents at_growth =
          -2 * stiffness_ * growth *
          (a * (G * change * G) + squared_thinning * trace * a * inverse_metric);
      const double strain_change =
          squared_thinning * trace - (G * change * G).cwiseProduct(metric).sum();
      derivative.col(3 + 3 * beta + i).tail<6>() =
          (at_growth + b_ * strain_change * pull).reshaped();
    }
  return derivative;
}

}  // namespace mammotwin
