#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "solver/gravity/inverse_equilibrium.h"
#include "tests/solver/dome_breast.h"
#include "tests/verification/plate_under_block.h"

// What a solve answers must not hang on its last digits: each runs with its numbers changed by up
// to 2e-9, and every test with each set of BLAS kernels that the processor has, which round
// differently too.

namespace mammotwin {
namespace {

constexpr int kPerturbations = 20;
constexpr double kPerturbation = 1e-10;

/// Smallest and largest of what was seen.
class Spread {
 public:
  void add(double value) {
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  double relative() const { return (high_ - low_) / std::abs(high_); }

 private:
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

// The block of FrictionTest, which slides while its rim lifts and comes down again: 1e6 and no
// stabilisation is the hardest that can be asked.
TEST(Rounding, ABlockSlidesAlike) {
  Spread normal, shear;
  for (int k = 0; k < kPerturbations; ++k) {
    PlateUnderBlock block(box_mesh({10, 8, 6}, {2, 2, 2}), false);
    block.press(1 + k * kPerturbation);
    block.draw(0.1, 1);
    block.draw(20, 8);
    ASSERT_FALSE(testing::Test::HasFailure()) << "at perturbation " << k;
    normal.add(block.force().z());
    shear.add(block.force().x());
    // Slips still turn a little towards x at the last steps: second order in the angle.
    EXPECT_NEAR(block.force().x() / block.force().z(), PlateUnderBlock::kCoefficient,
                1e-3 * PlateUnderBlock::kCoefficient);
  }
  // Friction's pressures are settled to 1e-5 of the flow.
  EXPECT_LT(normal.relative(), 1e-4);
  EXPECT_LT(shear.relative(), 1e-4);
}

TEST(Rounding, ABlockYieldsAlikeToAPlatesEdge) {
  Spread force;
  for (int k = 0; k < kPerturbations; ++k) {
    const HermiteMesh mesh = box_mesh({12, 12, 20}, {2, 2, 3});
    Model model(mesh, uniform(std::make_shared<NeoHookean>(3)), {});
    DofMap dofs(mesh);
    for (int axis = 0; axis < 3; ++axis) hold_plane(mesh, axis, 0, dofs);
    dofs.number(mesh);
    auto contact = std::make_shared<PlateContact>();
    const auto faces = faces_at(mesh, 2, 20);
    for (const auto& [e, face] : faces) model.add_surface_potential(e, face, contact);
    contact->plates = {Plate{{0, 5, 14 + k * kPerturbation}, {0, 0, -1}, {0, 1, 0}, 2}};
    State state = model.rest();
    Newton newton(model, dofs);
    const NewtonReport report = solve_contact(newton, *contact, 0.3, {}, state);
    ASSERT_TRUE(report.usable()) << report.reason << " at perturbation " << k;
    force.add(contact_figures(model, state, *contact, 0, faces).force.z());
  }
  EXPECT_LT(force.relative(), 1e-6);
}

// A breast that gravity presses on the chest, ever harder: which part of it leaves a shape that is
// stable is the tangent's to say. Beyond 0.85 none is.
TEST(Rounding, TheSameSharesOfGravityAreStable) {
  for (int k = 0; k < kPerturbations; ++k) {
    const double share = (k % 10 + 1) / 10.0;
    CompressionProblem problem = dome_problem(60);
    problem.mesh = dome_breast({2, 2, 1});
    problem.gravity = {0, share * 9810 * 25 * (1 + k * kPerturbation), 0};
    InverseEquilibrium solving(problem, SolidOptions{});
    State reference = solving.start();
    const NewtonReport report =
        solving.solve(reference, problem.density * problem.gravity, 1e-10, 12);
    ASSERT_TRUE(report.usable()) << report.reason << " at " << share;
    EXPECT_EQ(solving.stability_margin(reference) > 0, share < 0.86) << "at " << share;
  }
}

}  // namespace
}  // namespace mammotwin
