#include "solver/element/convex_part.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cstdlib>
#include <vector>

#include "solver/material/exponential.h"
#include "solver/material/kinematics.h"
#include "solver/material/neo_hookean.h"

namespace mammotwin {
namespace {

using Matrix = Eigen::Matrix3d;

TEST(ConvexPart, LeavesAPositiveDefiniteMatrixAsItIs) {
  Matrix m;
  m << 4, 1, 0, 1, 3, -1, 0, -1, 2;
  EXPECT_EQ(convex_part<3>(m), m);
}

// Eigenvalues 3 and -1 along (1, 1) and (1, -1), and 2: without the negative one 1.5 everywhere.
TEST(ConvexPart, TakesNegativeEigenvaluesOut) {
  Matrix m, expected;
  m << 1, 2, 0, 2, 1, 0, 0, 0, 2;
  expected << 1.5, 1.5, 0, 1.5, 1.5, 0, 0, 0, 2;
  EXPECT_LT((convex_part<3>(m) - expected).norm(), 1e-14);
}

TEST(ConvexPart, OfANegativeDefiniteMatrixIsNothing) {
  EXPECT_LT(convex_part<3>(-Matrix::Identity()).norm(), 1e-14);
}

/// ∂P/∂F of the law with a pressure's part at F.
Material::Tangent tangent_at(const Material& law, double pressure, const Eigen::Matrix3d& F) {
  Material::Tangent tangent = law.tangent(F);
  add_cofactor_tangent(pressure, F, tangent);
  return tangent;
}

// Where F is a rotation or a uniaxial stretch its singular vectors are not unique.
TEST(ConvexPart, OfAnIsotropicLawIsFoundByItsBlocks) {
  std::srand(1);
  std::vector<Eigen::Matrix3d> gradients;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  gradients.push_back(turn);
  gradients.push_back(turn * Eigen::Vector3d(1.6, 0.8, 0.8).asDiagonal());
  for (int n = 0; n < 20; ++n)
    gradients.push_back(Eigen::Matrix3d::Identity() + 0.3 * Eigen::Matrix3d::Random());
  const NeoHookean neo_hookean(1);
  const Exponential exponential(0.5, 3);
  int changed = 0;
  for (const Eigen::Matrix3d& F : gradients)
    for (const double pressure : {-8.0, 0.0, 8.0})
      for (const Material* law : std::array<const Material*, 2>{&neo_hookean, &exponential}) {
        const Material::Tangent tangent = tangent_at(*law, pressure, F),
                                expected = convex_part<9>(tangent);
        EXPECT_LT((isotropic_convex_part(tangent, F) - expected).norm(), 1e-12 * expected.norm());
        changed += (expected - tangent).norm() > 1e-6 * tangent.norm();
      }
  EXPECT_GT(changed, 40);
}

}  // namespace
}  // namespace mammotwin
