#include "fitting/solve/foldover_energy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
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

/// e = a |F|² + b with a and b functions of d, and their derivatives.
struct Parts {
  double a, a_by_d, a_by_dd, b, b_by_d, b_by_dd;

  Parts(double d, double epsilon) {
    constexpr double w = FoldoverEnergy::volume_weight;
    const double root = std::sqrt(d * d + epsilon * epsilon);
    const double g = (d + root) / 2, g_by_d = (1 + d / root) / 2,
                 g_by_dd = epsilon * epsilon / (2 * root * root * root);
    const double s = g_by_d / g, s_by_d = g_by_dd / g - s * s;  // of log g
    a = 1 / (3 * std::cbrt(g * g));
    a_by_d = -2 * a * s / 3;
    a_by_dd = -2 * (a_by_d * s + a * s_by_d) / 3;
    const double q = w / (2 * g), q_by_d = -q * s, q_by_dd = q * (s * s - s_by_d);
    b = q * (d * d + 1);
    b_by_d = q_by_d * (d * d + 1) + 2 * q * d;
    b_by_dd = q_by_dd * (d * d + 1) + 4 * q_by_d * d + 2 * q;
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

FoldoverEnergy::Hessian FoldoverEnergy::convex_hessian(const Eigen::Matrix3d& F,
                                                       double curvature) const {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d &U = svd.matrixU(), &V = svd.matrixV();
  Eigen::Vector3d s = svd.singularValues();  // signed, so that U diag(s) Vᵀ = F with rotations
  Eigen::Vector3d sign(1, 1, U.determinant() * V.determinant() < 0 ? -1 : 1);
  s = s.cwiseProduct(sign);
  const Eigen::Matrix3d Us = U * sign.asDiagonal();
  const Parts by(s.prod(), epsilon);
  const double squared = s.squaredNorm();
  const double along_d = by.a_by_d * squared + by.b_by_d;
  const Eigen::Vector3d p(s[1] * s[2], s[2] * s[0], s[0] * s[1]);  // ∂d/∂s

  const Eigen::Vector3d slope = 2 * by.a * s + along_d * p;
  Eigen::Matrix3d stretch = 2 * by.a * Eigen::Matrix3d::Identity() +
                            2 * by.a_by_d * (s * p.transpose() + p * s.transpose()) +
                            (by.a_by_dd * squared + by.b_by_dd) * p * p.transpose() +
                            curvature * slope * slope.transpose();
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    stretch(i, j) += along_d * s[k];
    stretch(j, i) += along_d * s[k];
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(stretch);

  Hessian hessian = Hessian::Zero();
  const auto add = [&](double stiffness, const Eigen::Matrix3d& mode) {
    if (stiffness <= 0) return;
    const Gradient m = (Us * mode * V.transpose()).reshaped();
    hessian += stiffness * m * m.transpose();
  };
  for (int m = 0; m < 3; ++m) add(modes.eigenvalues()[m], modes.eigenvectors().col(m).asDiagonal());
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    Eigen::Matrix3d mode = Eigen::Matrix3d::Zero();
    mode(i, j) = mode(j, i) = std::sqrt(0.5);  // shear
    add(2 * by.a - along_d * s[k], mode);
    mode(j, i) = -mode(i, j);  // turning
    add(2 * by.a + along_d * s[k], mode);
  }
  return hessian;
}

}  // namespace mammotwin
