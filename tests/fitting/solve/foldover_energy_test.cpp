#include "fitting/solve/foldover_energy.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
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

TEST(FoldoverEnergy, GradientMatchesDifferences) {
  const FoldoverEnergy e = FoldoverEnergy::for_smallest(-0.5);
  const double h = 1e-6;
  for (const auto& F : examples())
    for (int p = 0; p < 9; ++p) {
      Eigen::Matrix3d up = F, down = F;
      up.data()[p] += h;
      down.data()[p] -= h;
      const double difference = (e.value(up) - e.value(down)) / (2 * h);
      // h² times third derivatives, which grow as 1/ε³ = 1e3 of the value.
      EXPECT_NEAR(e.gradient(F)[p], difference, 1e-6 * (1 + e.gradient(F).norm()));
    }
}

TEST(FoldoverEnergy, HessianMatchesDifferences) {
  const FoldoverEnergy e = FoldoverEnergy::for_smallest(-0.5);
  const double h = 1e-6;
  for (const auto& F : examples())
    for (int p = 0; p < 9; ++p) {
      Eigen::Matrix3d up = F, down = F;
      up.data()[p] += h;
      down.data()[p] -= h;
      const FoldoverEnergy::Gradient difference = (e.gradient(up) - e.gradient(down)) / (2 * h);
      EXPECT_LT((e.hessian(F).col(p) - difference).norm(), 1e-6 * (1 + e.hessian(F).norm()));
    }
}

TEST(FoldoverEnergy, PositiveHessianIsTheHessianWithItsNegativeEigenvaluesAtZero) {
  const FoldoverEnergy e = FoldoverEnergy::for_smallest(-0.5);
  int negative = 0;
  for (const auto& F : examples()) {
    const Eigen::SelfAdjointEigenSolver<FoldoverEnergy::Hessian> eigen(e.hessian(F));
    negative += eigen.eigenvalues()[0] < 0;
    const FoldoverEnergy::Hessian expected = eigen.eigenvectors() *
                                             eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                                             eigen.eigenvectors().transpose();
    EXPECT_LT((e.positive_hessian(F) - expected).norm(), 1e-12 * expected.norm());
  }
  EXPECT_EQ(negative, 12);  // all of the examples
}

}  // namespace
}  // namespace mammotwin
