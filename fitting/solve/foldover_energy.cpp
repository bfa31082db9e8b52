#include "fitting/solve/foldover_energy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace mammotwin {

namespace {

constexpr double volume_weight = 0.05;  // w

/// e as a function of I = |F|² and d, with its derivatives.
struct Parts {
  double value, by_I, by_d, by_I_d, by_d_d;
};

Parts parts(double I, double d, double epsilon) {
  const double s = std::sqrt(d * d + epsilon * epsilon);
  const double g = (d + s) / 2, g1 = (1 + d / s) / 2, g2 = epsilon * epsilon / (2 * s * s * s);
  const double a = std::pow(g, -2.0 / 3) / 3;
  const double a1 = -2.0 / 3 * a / g, a2 = 10.0 / 9 * a / (g * g);  // by g
  const double q = d * d + 1;
  const double b = q / (2 * g);
  const double b1 = d / g - q * g1 / (2 * g * g);
  const double b2 =
      1 / g - 2 * d * g1 / (g * g) - q / 2 * (g2 / (g * g) - 2 * g1 * g1 / (g * g * g));
  return {I * a + volume_weight * b, a, I * a1 * g1 + volume_weight * b1, a1 * g1,
          I * (a2 * g1 * g1 + a1 * g2) + volume_weight * b2};
}

Eigen::Matrix3d cofactor(const Eigen::Matrix3d& F) {
  Eigen::Matrix3d c;
  for (int i = 0; i < 3; ++i) c.col(i) = F.col((i + 1) % 3).cross(F.col((i + 2) % 3));
  return c;
}

using Vector9 = FoldoverEnergy::Gradient;
Vector9 flat(const Eigen::Matrix3d& m) { return Eigen::Map<const Vector9>(m.data()); }

/// ∂ cof F / ∂F: the block of columns i and i + 1 is the cross-product matrix of ∓ column i + 2.
FoldoverEnergy::Hessian cofactor_derivative(const Eigen::Matrix3d& F) {
  FoldoverEnergy::Hessian h = FoldoverEnergy::Hessian::Zero();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Eigen::Vector3d v = F.col((i + 2) % 3);
    Eigen::Matrix3d cross;
    cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    h.block<3, 3>(3 * i, 3 * j) = -cross;
    h.block<3, 3>(3 * j, 3 * i) = cross;
  }
  return h;
}

FoldoverEnergy::Hessian hessian(const Eigen::Matrix3d& F, const Parts& p) {
  const Vector9 f = flat(F), c = flat(cofactor(F));
  FoldoverEnergy::Hessian h =
      2 * p.by_I * FoldoverEnergy::Hessian::Identity() + p.by_d * cofactor_derivative(F);
  h += p.by_d_d * c * c.transpose();
  h += 2 * p.by_I_d * (f * c.transpose() + c * f.transpose());
  return h;
}

/// F = u diag(sigma) vᵀ with rotations u and v: the smallest singular value has the sign of det F.
struct RotationSvd {
  Eigen::Matrix3d u, v;
  Eigen::Vector3d sigma;

  explicit RotationSvd(const Eigen::Matrix3d& F) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    u = svd.matrixU();
    v = svd.matrixV();
    sigma = svd.singularValues();
    if (u.determinant() < 0) u.col(2) *= -1, sigma[2] *= -1;
    if (v.determinant() < 0) v.col(2) *= -1, sigma[2] *= -1;
  }
};

/// Second derivatives of e by the singular values.
Eigen::Matrix3d scaling_hessian(const Eigen::Vector3d& s, const Parts& p) {
  const Eigen::Vector3d c(s.y() * s.z(), s.z() * s.x(), s.x() * s.y());
  Eigen::Matrix3d h = p.by_d_d * c * c.transpose();
  h += 2 * p.by_I_d * (s * c.transpose() + c * s.transpose());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) h(i, j) += i == j ? 2 * p.by_I : p.by_d * s[3 - i - j];
  return h;
}

/// Brings a negative eigenvalue to zero; its eigenvector is a matrix of norm 1.
void lift(double eigenvalue, const Eigen::Matrix3d& mode, FoldoverEnergy::Hessian& h) {
  if (eigenvalue >= 0) return;
  const Vector9 m = flat(mode);
  h -= eigenvalue * m * m.transpose();
}

}  // namespace

FoldoverEnergy FoldoverEnergy::for_smallest(double d_min) {
  const double folded = std::min(d_min, 0.0);
  return {std::sqrt(1e-6 + 0.04 * folded * folded)};
}

double FoldoverEnergy::value(const Eigen::Matrix3d& F) const {
  return parts(F.squaredNorm(), F.determinant(), epsilon).value;
}

FoldoverEnergy::Gradient FoldoverEnergy::gradient(const Eigen::Matrix3d& F) const {
  const Parts p = parts(F.squaredNorm(), F.determinant(), epsilon);
  return 2 * p.by_I * flat(F) + p.by_d * flat(cofactor(F));
}

FoldoverEnergy::Hessian FoldoverEnergy::hessian(const Eigen::Matrix3d& F) const {
  return mammotwin::hessian(F, parts(F.squaredNorm(), F.determinant(), epsilon));
}

// Eigenvectors by singular vectors: Smith, de Goes, Kim, "Analytic eigensystems for isotropic
// distortion energies", ACM Trans. Graph. 38(1), 2019. A quarter of the time of a 9 x 9 solver.
FoldoverEnergy::Hessian FoldoverEnergy::positive_hessian(const Eigen::Matrix3d& F) const {
  const Parts p = parts(F.squaredNorm(), F.determinant(), epsilon);
  const RotationSvd svd(F);
  Hessian h = mammotwin::hessian(F, p);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const Eigen::Matrix3d ij = svd.u.col(i) * svd.v.col(j).transpose();
    const Eigen::Matrix3d ji = svd.u.col(j) * svd.v.col(i).transpose();
    const double turn = p.by_d * svd.sigma[k];
    lift(2 * p.by_I - turn, M_SQRT1_2 * (ij + ji), h);
    lift(2 * p.by_I + turn, M_SQRT1_2 * (ij - ji), h);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> scaling(scaling_hessian(svd.sigma, p));
  for (int m = 0; m < 3; ++m)
    lift(scaling.eigenvalues()[m],
         svd.u * scaling.eigenvectors().col(m).asDiagonal() * svd.v.transpose(), h);
  return h;
}

}  // namespace mammotwin
