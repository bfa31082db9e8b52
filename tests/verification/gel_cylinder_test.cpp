#include "pipeline/validation/gel_cylinder/gel_cylinder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mammotwin::gel_cylinder_test {
namespace {

CylinderFigures squeeze(CylinderCase how, const CylinderElements& elements, double thickness = 17) {
  CylinderExperiment experiment;
  experiment.how = how;
  experiment.elements = elements;
  experiment.thickness = thickness;
  return squeeze_cylinder(experiment);
}

// References: FEBio 4 (three-field hexahedra, h² limit), CalculiX C3D20R and an exactly
// incompressible Q2/P1 code, which agree within the stated errors (sample_data/gel_cylinder).
// Meshes are the recommended ones, tolerances those that the references' own errors (0.1 %, 0.01
// mm) allow.
TEST(GelCylinder, LateralSqueezeIsThePeers) {
  const auto f = squeeze(CylinderCase::lateral, {6, 1, 4});
  ASSERT_TRUE(f.usable) << f.reason;
  EXPECT_NEAR(f.force_N / 8.515, 1, 0.003);
  EXPECT_NEAR(f.half_width_middle_mm, 17.404, 0.0145);  // 0.5 % of the radial strain
  EXPECT_NEAR(f.half_width_end_mm, 18.606, 0.02);
  EXPECT_NEAR(f.half_length_axis_mm, 24.543, 0.02);
  EXPECT_LE(f.penetration_mm, 0.001);
}

TEST(GelCylinder, PlaneStrainSqueezeIsThePeers) {
  const auto f = squeeze(CylinderCase::plane_strain, {8, 2, 1});
  ASSERT_TRUE(f.usable) << f.reason;
  EXPECT_NEAR(f.force_N / 14.52, 1, 0.003);
  EXPECT_NEAR(f.half_width_middle_mm, 20.880, 0.02);
}

// Exact: F = 2 c₁ A₀ (λ⁻² − λ) with λ = 17 / 40. This is arithmetic, not an experiment: beyond λ =
// 0.680 (27.2 mm) the equilibrium is unstable, and a real cylinder would shear off to the side; an
// eighth with its mirrors and a coarse mesh follows the homogeneous path.
TEST(GelCylinder, AxialSqueezeIsTheClosedForm) {
  const double stretch = 17.0 / 40;
  const auto f = squeeze(CylinderCase::axial, {2, 1, 1});
  ASSERT_TRUE(f.usable) << f.reason;
  const double area = std::numbers::pi * 14.5 * 14.5;
  const double force = 2 * 3 * area * (1 / (stretch * stretch) - stretch) * 1e-3;
  EXPECT_NEAR(f.force_N / force, 1, 1e-4);  // the mesh's circle is off by 5e-6 of the radius
  EXPECT_NEAR(f.half_width_middle_mm, 14.5 / std::sqrt(stretch), 1e-3);
}

// Reference: Q2/P1 code. Mesh graded towards the bonded edge, where the stress is singular. Below
// 32 mm the mantle folds over the edge, so the bulge counts at 32 mm and the force at 28.
TEST(GelCylinder, BondedSqueezeIsThePeers) {
  const CylinderElements graded{4, 3, 5, 0.5, 0.5, 0.4};
  const auto high = squeeze(CylinderCase::bonded, graded, 32);
  ASSERT_TRUE(high.usable) << high.reason;
  EXPECT_NEAR(high.force_N / 3.3287, 1, 0.003);
  EXPECT_NEAR(high.half_width_middle_mm, 16.461, 0.02);
  const auto low = squeeze(CylinderCase::bonded, graded, 28);
  ASSERT_TRUE(low.usable) << low.reason;
  EXPECT_NEAR(low.force_N / 5.523, 1, 0.003);
}

// As the paper ran it: half the cylinder and one plate. The eighth is its mirror-symmetric
// subspace, so the two differ by what Newton leaves (1e-7) only.
TEST(GelCylinder, HalfWithOnePlateIsTheEighth) {
  CylinderExperiment experiment;
  experiment.elements = even_elements(1);
  const auto eighth = squeeze_cylinder(experiment);
  experiment.part = CylinderPart::half;
  const auto half = squeeze_cylinder(experiment);
  ASSERT_TRUE(eighth.usable && half.usable) << eighth.reason << half.reason;
  EXPECT_GT(half.dof, 3 * eighth.dof);
  EXPECT_NEAR(half.force_N / eighth.force_N, 1, 1e-6);
  EXPECT_NEAR(half.half_width_middle_mm, eighth.half_width_middle_mm, 1e-5);
  EXPECT_NEAR(half.half_length_axis_mm, eighth.half_length_axis_mm, 1e-5);
}

TEST(GelCylinder, RefusesWhatItCannotMesh) {
  CylinderExperiment odd;
  odd.elements.square = 3;
  EXPECT_THROW(squeeze_cylinder(odd), std::invalid_argument);
  CylinderExperiment standing;
  standing.how = CylinderCase::bonded;
  standing.part = CylinderPart::half;
  EXPECT_THROW(squeeze_cylinder(standing), std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin::gel_cylinder_test
