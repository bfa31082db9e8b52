#include "fitting/solve/foldover_energy.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace mammotwin {

namespace {

Eigen::Matrix3d cofactor(const Eigen::Matrix3d& F) {
  Eigen::Matrix3d c;
  for (int i = 0; i < 3; ++i) c.col(i) = F.col((i + 1) % 3).cross(F.col((i + 2) % 3));
  return c;
}

/// The residuals as functions of d: h F, k d and k, with their derivatives.
struct Factors {
  double h, h_by_d, k, k_by_d, kd_by_d;

  Factors(double d, double epsilon) {
    const double root = std::sqrt(d * d + epsilon * epsilon);
    const double g = (d + root) / 2, g_by_d = (1 + d / root) / 2;
    h = 1 / (std::sqrt(3.0) * std::cbrt(g));
    h_by_d = -h * g_by_d / (3 * g);
    k = std::sqrt(FoldoverEnergy::volume_weight / 2 / g);
    k_by_d = -k * g_by_d / (2 * g);
    kd_by_d = k + d * k_by_d;
  }
};

}  // namespace

FoldoverEnergy FoldoverEnergy::for_smallest(double d_min) {
  const double folded = std::min(d_min, 0.0);
  return {std::sqrt(1e-6 + 0.04 * folded * folded)};
}

FoldoverEnergy::Gradient FoldoverEnergy::gradient(const Eigen::Matrix3d& F) const {
  const double d = F.determinant();
  const Factors by(d, epsilon);
  const double along_cofactor =
      by.h * by.h_by_d * F.squaredNorm() + by.k * (d * by.kd_by_d + by.k_by_d);
  const Eigen::Matrix3d c = cofactor(F);
  return 2 * (by.h * by.h * F + along_cofactor * c).reshaped();
}

FoldoverEnergy::Hessian FoldoverEnergy::gauss_newton(const Eigen::Matrix3d& F) const {
  const Factors by(F.determinant(), epsilon);
  const Gradient f = F.reshaped(), c = cofactor(F).reshaped();
  const double along_cofactor =
      F.squaredNorm() * by.h_by_d * by.h_by_d + by.kd_by_d * by.kd_by_d + by.k_by_d * by.k_by_d;
  Hessian half = by.h * by.h * Hessian::Identity();
  half += by.h * by.h_by_d * (f * c.transpose() + c * f.transpose());
  half += along_cofactor * c * c.transpose();
  return 2 * half;
}

}  // namespace mammotwin
