#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "solver/material/material.h"

namespace mammotwin {

/// What every hyperelastic law must satisfy, checked at one deformation gradient F.
/// A new law's test calls this first, then adds the values that are its own.
inline void expect_material_laws(const Material& law, const Eigen::Matrix3d& F) {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  EXPECT_NEAR(law.energy(I), 0, 1e-14) << "energy at rest";
  EXPECT_NEAR(law.stress(I).norm(), 0, 1e-12) << "stress at rest";
  EXPECT_EQ(law.energy(-I), std::numeric_limits<double>::infinity()) << "inverted";

  // Objectivity: a rotation Q after F leaves W unchanged and carries P to QP; isotropy: one before
  // F changes nothing either. Rounding grows with W and P.
  const Eigen::Matrix3d Q(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  const Eigen::Matrix3d P = law.stress(F);
  const double W = law.energy(F);
  EXPECT_NEAR(law.energy(Q * F), W, 1e-13 * (1 + std::abs(W)));
  EXPECT_NEAR(law.energy(F * Q), W, 1e-13 * (1 + std::abs(W)));
  EXPECT_NEAR((law.stress(Q * F) - Q * P).norm(), 0, 1e-13 * (1 + P.norm()));

  // P = ∂W/∂F and A = ∂P/∂F by central differences. At h = 1e-5 their error, h² + ε/h, is about
  // 1e-10 for entries of order one; the bound leaves a factor of 100 and grows with the entries.
  const double h = 1e-5;
  const auto A = law.tangent(F);
  for (int c = 0; c < 9; ++c) {
    Eigen::Matrix3d dF = Eigen::Matrix3d::Zero();
    dF(c % 3, c / 3) = h;
    EXPECT_NEAR((law.energy(F + dF) - law.energy(F - dF)) / (2 * h), P(c), 1e-8 * (1 + P.norm()));
    const Eigen::Matrix3d dP = (law.stress(F + dF) - law.stress(F - dF)) / (2 * h);
    EXPECT_NEAR((dP.reshaped() - A.col(c)).norm(), 0, 1e-8 * (1 + A.norm()));
  }
  EXPECT_NEAR((A - A.transpose()).norm(), 0, 1e-13 * A.norm()) << "a potential's tangent";

  // Small strain: shear stress over shear is the modulus that the law states, to first order.
  const double shear = 1e-6;
  Eigen::Matrix3d small = I;
  small(0, 1) = shear;
  EXPECT_NEAR(law.stress(small)(0, 1) / shear, law.shear_modulus(), 1e-5 * law.shear_modulus());
}

/// Deformation gradients of all sorts: J from 0.7 to 1.3, stretches from 0.5 to 1.8, rotated.
inline std::vector<Eigen::Matrix3d> deformation_gradients() {
  std::vector<Eigen::Matrix3d> all(4, Eigen::Matrix3d::Identity());
  all[1] << 1.1, 0.3, -0.2, 0.1, 0.9, 0.15, -0.05, 0.2, 1.05;
  const Eigen::Matrix3d R(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, -1, 0.5).normalized()));
  all[2] = R * Eigen::Vector3d(0.5, 1.6, 1.25).asDiagonal();
  all[3] << 0.7, 0.4, 0.0, -0.3, 1.2, 0.2, 0.1, -0.1, 0.8;
  return all;
}

}  // namespace mammotwin
