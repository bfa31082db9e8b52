#include "solver/material/exponential.h"

#include <Eigen/LU>
#include <cmath>

#include "solver/material/kinematics.h"
#include "solver/material/positive_modulus.h"

namespace mammotwin {

Exponential::Exponential(double c1, double b)
    : c1_(positive_modulus("c1 (exponential)", c1)), b_(positive_modulus("b (exponential)", b)) {}

double Exponential::growth(const Eigen::Matrix3d& F) const {
  return std::exp(b_ * (F.squaredNorm() - 3));
}

double Exponential::energy(const Eigen::Matrix3d& F) const {
  return c1_ / b_ * std::expm1(b_ * (F.squaredNorm() - 3)) + 2 * c1_ * minus_log_jacobian(F);
}

Eigen::Matrix3d Exponential::stress(const Eigen::Matrix3d& F) const {
  return 2 * c1_ * (growth(F) * F - F.inverse().transpose());
}

Material::Tangent Exponential::tangent(const Eigen::Matrix3d& F) const {
  const auto f = F.reshaped();
  Tangent A = 2 * c1_ * growth(F) * (Tangent::Identity() + 2 * b_ * f * f.transpose());
  add_inverse_tangent(2 * c1_, F, A);
  return A;
}

}  // namespace mammotwin
