#include "solver/material/exponential.h"
#include "solver/material/mixture.h"
#include "solver/material/mooney_rivlin.h"
#include "solver/material/neo_hookean.h"
#include "tests/solver/material/material_laws.h"

namespace mammotwin {
namespace {

TEST(NeoHookean, ObeysTheLawsOfMaterials) {
  for (const auto& F : deformation_gradients()) expect_material_laws(NeoHookean(0.75), F);
}

TEST(MooneyRivlin, ObeysTheLawsOfMaterials) {
  for (const auto& F : deformation_gradients()) expect_material_laws(MooneyRivlin(0.6, 0.3), F);
}

TEST(Exponential, ObeysTheLawsOfMaterials) {
  for (const auto& F : deformation_gradients()) expect_material_laws(Exponential(0.6, 1.5), F);
}

TEST(Exponential, ObeysTheLawsOfMaterialsWhereItsStiffeningEnds) {
  for (const double most : {1.0, 4.0, 1e6})
    for (const auto& F : deformation_gradients())
      expect_material_laws(Exponential(0.6, 1.5, most), F);
}

Mixture::Laws three_laws() {
  return {std::make_shared<NeoHookean>(0.75), std::make_shared<MooneyRivlin>(2.0, 0.5),
          std::make_shared<Exponential>(3.3, 0.8)};
}

TEST(Mixture, ObeysTheLawsOfMaterials) {
  for (const auto mixing : {Mixing::arithmetic, Mixing::geometric, Mixing::harmonic})
    for (const auto& F : deformation_gradients())
      expect_material_laws(Mixture(mixing, {0.5, 0.3, 0.2}, three_laws()), F);
}

// Uniaxial, incompressible: the pressure that frees the sides leaves σ = 2 c₁ (λ² − 1/λ), so
// P = 2 c₁ (λ − λ⁻²) (paper, eq. 9; any text on rubber elasticity).
TEST(NeoHookean, UniaxialStressIsTheClosedForm) {
  const double c1 = 3, stretch = 0.425;
  const double side = 1 / std::sqrt(stretch);
  const Eigen::Matrix3d F = Eigen::Vector3d(side, side, stretch).asDiagonal();
  const Eigen::Matrix3d P = NeoHookean(c1).stress(F);
  const double p = -P(0, 0) * side;  // P + p F⁻ᵀ vanishes at the sides
  EXPECT_NEAR(P(2, 2) + p / stretch, 2 * c1 * (stretch - 1 / (stretch * stretch)), 1e-12);
}

TEST(Exponential, IsNeoHookeanForSmallExponents) {
  const Eigen::Matrix3d F = deformation_gradients()[1];
  EXPECT_NEAR((Exponential(2, 1e-9).stress(F) - NeoHookean(2).stress(F)).norm(), 0, 1e-8);
}

TEST(Exponential, StiffensToItsLimitAndNoFarther) {
  const Exponential law(2, 1.5, 8);
  const auto stretched = [](double by) {
    return Eigen::Matrix3d(Eigen::Vector3d(by, 1 / std::sqrt(by), 1 / std::sqrt(by)).asDiagonal());
  };
  const auto growth = [&](const Eigen::Matrix3d& F) {
    return (law.stress(F) + 4 * F.inverse().transpose()).norm() / (4 * F.norm());
  };
  EXPECT_NEAR(growth(Eigen::Matrix3d::Identity()), 1, 1e-14);
  EXPECT_NEAR(growth(stretched(40)), 8, 1e-12);
  // Half way where exp(b (I1 - 3)) = m - 1 (a logistic's middle).
  Eigen::Matrix3d middle = Eigen::Matrix3d::Zero();
  middle.diagonal().setConstant(std::sqrt(1 + std::log(7) / 1.5 / 3));
  EXPECT_NEAR(growth(middle), 4, 1e-12);
  // Energy and its slope far beyond where the exponential of itself overflows.
  const Eigen::Matrix3d far = stretched(40);
  const double h = 1e-6;
  EXPECT_NEAR((law.energy((1 + h) * far) - law.energy((1 - h) * far)) / (2 * h),
              law.stress(far).cwiseProduct(far).sum(), 1e-4 * law.energy(far));
}

TEST(Mixture, ModulusFollowsTheRule) {
  // Half 2, half 8: mean 5, geometric mean 4, harmonic mean 3.2.
  const std::array<double, 3> f{0.5, 0.5, 0}, mu{2, 8, 100};
  EXPECT_DOUBLE_EQ(mixed_modulus(Mixing::arithmetic, f, mu), 5);
  EXPECT_DOUBLE_EQ(mixed_modulus(Mixing::geometric, f, mu), 4);
  EXPECT_DOUBLE_EQ(mixed_modulus(Mixing::harmonic, f, mu), 3.2);
}

TEST(Material, RefusesStiffnessThatIsNotPositive) {
  EXPECT_THROW(NeoHookean(0), std::invalid_argument);
  EXPECT_THROW(NeoHookean(-1), std::invalid_argument);
  EXPECT_THROW(NeoHookean(std::nan("")), std::invalid_argument);
  EXPECT_THROW(MooneyRivlin(1, -1), std::invalid_argument);
  EXPECT_THROW(Exponential(1, 0), std::invalid_argument);
  EXPECT_THROW(Exponential(1, 1, 0.5), std::invalid_argument);
  EXPECT_THROW(Mixture(Mixing::geometric, {0.5, 0.3, 0.1}, three_laws()), std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin
