#include "solver/material/neo_hookean.h"

#include <Eigen/LU>

#include "solver/material/kinematics.h"
#include "solver/material/positive_modulus.h"

namespace mammotwin {

NeoHookean::NeoHookean(double c1) : c1_(positive_modulus("c1 (neo-Hookean)", c1)) {}

double NeoHookean::energy(const Eigen::Matrix3d& F) const {
  return c1_ * (F.squaredNorm() - 3 + 2 * minus_log_jacobian(F));
}

Eigen::Matrix3d NeoHookean::stress(const Eigen::Matrix3d& F) const {
  return 2 * c1_ * (F - F.inverse().transpose());
}

Material::Tangent NeoHookean::tangent(const Eigen::Matrix3d& F) const {
  Tangent A = 2 * c1_ * Tangent::Identity();
  add_inverse_tangent(2 * c1_, F, A);
  return A;
}

}  // namespace mammotwin
