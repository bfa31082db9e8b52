#include "solver/material/mooney_rivlin.h"

#include <Eigen/LU>

#include "solver/material/kinematics.h"
#include "solver/material/positive_modulus.h"

namespace mammotwin {

MooneyRivlin::MooneyRivlin(double c1, double c2)
    : c1_(positive_modulus("c1 (Mooney-Rivlin)", c1)),
      c2_(c2 == 0 ? 0 : positive_modulus("c2 (Mooney-Rivlin)", c2)) {}

double MooneyRivlin::energy(const Eigen::Matrix3d& F) const {
  const Eigen::Matrix3d C = F.transpose() * F;
  const double I1 = C.trace();
  const double I2 = (I1 * I1 - C.squaredNorm()) / 2;
  return c1_ * (I1 - 3) + c2_ * (I2 - 3) + 2 * (c1_ + 2 * c2_) * minus_log_jacobian(F);
}

Eigen::Matrix3d MooneyRivlin::stress(const Eigen::Matrix3d& F) const {
  const Eigen::Matrix3d C = F.transpose() * F;
  return 2 * c1_ * F + 2 * c2_ * (C.trace() * F - F * C) -
         2 * (c1_ + 2 * c2_) * F.inverse().transpose();
}

Material::Tangent MooneyRivlin::tangent(const Eigen::Matrix3d& F) const {
  const Eigen::Matrix3d C = F.transpose() * F, b = F * F.transpose();
  const double I1 = C.trace();
  Tangent A = 2 * (c1_ + c2_ * I1) * Tangent::Identity();
  for (int l = 0; l < 3; ++l)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          A(i + 3 * j, k + 3 * l) +=
              2 * c2_ *
              (2 * F(i, j) * F(k, l) - F(i, l) * F(k, j) - (i == k) * C(l, j) - (j == l) * b(i, k));
  add_inverse_tangent(2 * (c1_ + 2 * c2_), F, A);
  return A;
}

}  // namespace mammotwin
