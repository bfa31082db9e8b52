#include "fitting/solve/foldover_energy.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace mammotwin {
namespace {

std::vector<Eigen::Matrix3d> examples() {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Eigen::Matrix3d> all;
  for (double identity : {1.0, 0.6, 0.0, -0.7})  // the last ones are folded
    for (int i = 0; i < 3; ++i) {
      Eigen::Matrix3d F = identity * Eigen::Matrix3d::Identity();
      for (double& x : F.reshaped()) x += 0.4 * uniform(random);
      all.push_back(F);
    }
  return all;
}

TEST(FoldoverEnergy, IsOnePlusWeightForARotation) {
  const FoldoverEnergy e{1e-6};
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  EXPECT_NEAR(e.value(R), 1.05, 1e-11);  // ε²/4 = 2.5e-13 enters through g
  EXPECT_LT(e.gradient(R).norm(), 1e-11);
}

TEST(FoldoverEnergy, DoesNotSeeRotations) {
  const FoldoverEnergy e = FoldoverEnergy::for_smallest(-0.5);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(2, Eigen::Vector3d(3, -1, 1).normalized()).matrix();
  for (const auto& F : examples()) EXPECT_NEAR(e.value(R * F) / e.value(F), 1, 1e-11);
}

/// The residuals and their derivatives by F, by automatic differentiation.
struct Differentiated {
  Eigen::Matrix<double, 11, 1> residuals;
  Eigen::Matrix<double, 11, 9> jacobian;

  Differentiated(const FoldoverEnergy& e, const Eigen::Matrix3d& F) {
    using Jet = ceres::Jet<double, 9>;
    Eigen::Matrix<Jet, 3, 3> variable;
    for (int p = 0; p < 9; ++p) variable.data()[p] = Jet(F.data()[p], p);
    const auto r = e.residuals(variable);
    for (int i = 0; i < 11; ++i) {
      residuals[i] = r[i].a;
      jacobian.row(i) = r[i].v.transpose();
    }
  }
};

TEST(FoldoverEnergy, IsWhatItsHeaderSaysAndTheSumOfItsResidualsSquares) {
  const FoldoverEnergy e = FoldoverEnergy::for_smallest(-0.5);
  for (const auto& F : examples()) {
    const double d = F.determinant(), g = (d + std::hypot(d, e.epsilon)) / 2;
    const double expected =
        F.squaredNorm() / (3 * std::pow(g, 2.0 / 3)) + 0.05 * (d * d + 1) / (2 * g);
    EXPECT_NEAR(e.value(F) / expected, 1, 1e-13);
    EXPECT_NEAR(Differentiated(e, F).residuals.squaredNorm() / expected, 1, 1e-13);
  }
}

TEST(FoldoverEnergy, GradientIsThatOfItsResiduals) {
  const FoldoverEnergy e = FoldoverEnergy::for_smallest(-0.5);
  for (const auto& F : examples()) {
    const Differentiated by(e, F);
    const FoldoverEnergy::Gradient expected = 2 * by.jacobian.transpose() * by.residuals;
    EXPECT_LT((e.gradient(F) - expected).norm(), 1e-12 * (1 + expected.norm()));
  }
}

TEST(FoldoverEnergy, GaussNewtonHessianIsThatOfItsResiduals) {
  const FoldoverEnergy e = FoldoverEnergy::for_smallest(-0.5);
  for (const auto& F : examples()) {
    const Differentiated by(e, F);
    const FoldoverEnergy::Hessian expected = 2 * by.jacobian.transpose() * by.jacobian;
    EXPECT_LT((e.gauss_newton(F) - expected).norm(), 1e-12 * expected.norm());
  }
}

/// The Hessian by differences of the gradient, its negative eigenvalues set to 0.
FoldoverEnergy::Hessian convex_by_differences(const FoldoverEnergy& e, const Eigen::Matrix3d& F,
                                              double curvature) {
  constexpr double h = 1e-6;
  FoldoverEnergy::Hessian hessian;
  for (int p = 0; p < 9; ++p) {
    Eigen::Matrix3d up = F, down = F;
    up.data()[p] += h;
    down.data()[p] -= h;
    hessian.col(p) = (e.gradient(up) - e.gradient(down)) / (2 * h);
  }
  hessian += curvature * e.gradient(F) * e.gradient(F).transpose();
  const Eigen::SelfAdjointEigenSolver<FoldoverEnergy::Hessian> modes(
      (hessian + hessian.transpose()) / 2);
  return modes.eigenvectors() * modes.eigenvalues().cwiseMax(0).asDiagonal() *
         modes.eigenvectors().transpose();
}

TEST(FoldoverEnergy, ConvexHessianIsTheHessianWithoutItsNegativeEigenvalues) {
  const FoldoverEnergy e = FoldoverEnergy::for_smallest(-0.5);
  for (const auto& F : examples())
    for (double curvature : {0.0, 2.0}) {
      const FoldoverEnergy::Hessian expected = convex_by_differences(e, F, curvature);
      // Differences of 1e-6 leave (1e-6)² of third derivatives, and 1e-16 / 1e-6 of rounding.
      EXPECT_LT((e.convex_hessian(F, curvature) - expected).norm(), 1e-7 * expected.norm());
    }
}

// All singular values equal, and two of them: the eigenvectors are not unique there.
TEST(FoldoverEnergy, ConvexHessianDoesNotMindEqualSingularValues) {
  const FoldoverEnergy e{1e-3};
  for (double third : {1.0, 0.5}) {
    const Eigen::Matrix3d F = Eigen::Vector3d(1, 1, third).asDiagonal();
    const FoldoverEnergy::Hessian expected = convex_by_differences(e, F, 0);
    EXPECT_LT((e.convex_hessian(F) - expected).norm(), 1e-7 * expected.norm());
  }
}

}  // namespace
}  // namespace mammotwin
