#include "solver/material/exponential.h"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <string>

#include "solver/material/kinematics.h"
#include "solver/material/positive_modulus.h"

namespace mammotwin {

Exponential::Exponential(double c1, double b, double most)
    : c1_(positive_modulus("c1 (exponential)", c1)),
      b_(positive_modulus("b (exponential)", b)),
      limit_(1 / most) {
  if (!(most >= 1))
    throw std::invalid_argument("the most stiffening (exponential) is " + std::to_string(most) +
                                "; expected 1 or more");
}

/// Of the stress over F: exp(b (I₁ − 3)) where nothing limits it.
double Exponential::growth(const Eigen::Matrix3d& F) const {
  const double exponent = b_ * (F.squaredNorm() - 3);
  if (limit_ == 0) return std::exp(exponent);
  return 1 / (limit_ + (1 - limit_) * std::exp(-exponent));
}

double Exponential::energy(const Eigen::Matrix3d& F) const {
  constexpr double large = 30;  // its exponential outgrows 1 by all digits
  const double exponent = b_ * (F.squaredNorm() - 3);
  const double logarithm = 2 * c1_ * minus_log_jacobian(F);
  if (limit_ == 0) return c1_ / b_ * std::expm1(exponent) + logarithm;
  const double grown = exponent < large
                           ? std::log1p(limit_ * std::expm1(exponent))
                           : exponent + std::log(limit_ + (1 - limit_) * std::exp(-exponent));
  return c1_ / (b_ * limit_) * grown + logarithm;
}

Eigen::Matrix3d Exponential::stress(const Eigen::Matrix3d& F) const {
  return 2 * c1_ * (growth(F) * F - F.inverse().transpose());
}

Material::Tangent Exponential::tangent(const Eigen::Matrix3d& F) const {
  const auto f = F.reshaped();
  const double g = growth(F);
  Tangent A = 2 * c1_ * g * (Tangent::Identity() + 2 * b_ * (1 - g * limit_) * f * f.transpose());
  add_inverse_tangent(2 * c1_, F, A);
  return A;
}

}  // namespace mammotwin
