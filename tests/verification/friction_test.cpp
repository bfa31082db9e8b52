#include <gtest/gtest.h>

#include <cmath>

#include "solver/contact/contact_figures.h"
#include "solver/contact/penalty_continuation.h"
#include "solver/material/neo_hookean.h"
#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

constexpr double kC1 = 3;  // [kPa]
constexpr double kCoefficient = 0.4, kSlip = 0.02;

/// A block held at its top, and a plate that presses from below and is then drawn along x. With
/// `endless`, x = 0 and x = L move alike (a cut out of an endless strip).
class PlateUnderBlock {
 public:
  PlateUnderBlock(const HermiteMesh& mesh, bool endless)
      : mesh_(mesh),
        model_(mesh, uniform(std::make_shared<NeoHookean>(kC1)),
               {PressureSpace::trilinear, 1e6, 0}),
        dofs_(mesh) {
    faces_ = faces_in_plane(mesh, 2, 0);
    contact_->penalty = 1000;
    contact_->plates = {Plate{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0, true}};
    for (const auto& [e, face] : faces_) {
      model_.add_surface_potential(e, face, contact_, contact_->points1d);
      model_.add_surface_potential(e, face, friction_, contact_->points1d);
    }
    const double height = mesh.nodes().back()(2, 0);
    for (int axis : {0, 2}) hold_plane_along(axis, height);
    hold_plane(mesh, 1, 0, dofs_);
    if (endless) tie_ends();
    dofs_.number(mesh);
    newton_ = std::make_unique<Newton>(model_, dofs_);
    friction_->commit(model_, state_, faces_);
  }

  /// Presses by `depth` without friction; from there on the block sticks.
  void press(double depth) {
    contact_->follow = {};
    contact_->plates[0].point.z() = depth;
    settle();
    friction_->restore({});
    friction_->commit(model_, state_, faces_);
    contact_->follow = [this](const State& s) { friction_->track(model_, s, faces_); };
  }

  /// Draws the plate along x, in equal steps.
  void draw(double distance, int steps) {
    for (int step = 0; step < steps; ++step) {
      contact_->plates[0].point.x() += distance / steps;
      settle();
      friction_->commit(model_, state_, faces_);
    }
  }

  Eigen::Vector3d force() const {  ///< of the plate [mN]
    return contact_figures(model_, state_, *contact_, 0, faces_, friction_.get()).force;
  }
  Eigen::Vector3d top_force() const {  ///< of what holds the top, from the residual
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const auto residual = newton_->assembler().nodal_residual(state_);
    for (int i = 0; i < mesh_.num_nodes(); ++i)
      if (mesh_.node(i)(2, 0) > mesh_.nodes().back()(2, 0) - 1e-9) sum += residual[i].col(0);
    return sum;
  }
  const State& state() const { return state_; }
  const HermiteMesh& mesh() const { return mesh_; }
  const PlateFriction& friction() const { return *friction_; }
  double plate_x() const { return contact_->plates[0].point.x(); }

 private:
  void settle() {
    NewtonOptions options;
    options.tolerance = 1e-9;
    const NewtonReport report = resettle(*newton_, *contact_, options, state_);
    ASSERT_TRUE(report.usable()) << report.reason;
  }
  void hold_plane_along(int component, double height) {
    for (const auto& [e, face] : faces_in_plane(mesh_, 2, height))
      for (int dof : face_dofs(mesh_, e, face, component)) dofs_.prescribe(dof);
  }
  void tie_ends() {
    for (int i = 0; i < mesh_.num_nodes(); ++i)
      for (int j = 0; j < mesh_.num_nodes(); ++j) {
        const Eigen::Vector3d apart = mesh_.node(j).col(0) - mesh_.node(i).col(0);
        if (mesh_.node(i)(0, 0) > 1e-9 || apart.x() < 1e-9 || apart.tail<2>().norm() > 1e-9 ||
            mesh_.node(j)(0, 0) < mesh_.nodes().back()(0, 0) - 1e-9)
          continue;
        for (int k = 0; k < 24; ++k) dofs_.tie(24 * j + k, 24 * i + k, 1);
      }
  }

  HermiteMesh mesh_;
  Model model_;
  DofMap dofs_;
  std::shared_ptr<PlateContact> contact_ = std::make_shared<PlateContact>();
  std::shared_ptr<PlateFriction> friction_ =
      std::make_shared<PlateFriction>(contact_, kCoefficient, kSlip);
  std::vector<std::pair<int, int>> faces_;
  State state_ = model_.rest();
  std::unique_ptr<Newton> newton_;
};

// An endless strip, free at y = W, under compression λz = λ, λy = 1/λ and simple shear g: with
// σ_yy = 0, σ_zz = 2c₁(λz² − λy²) and σ_xz = 2c₁ λz g where x = X + gZ (σ = 2c₁B + q). Per
// reference area (x λy): normal 2c₁(λ − λ⁻³), shear 2c₁ g. So it sticks until g = μ(λ⁻³ − λ), and
// then no shear is added however far the plate goes.
TEST(Friction, StripSlidesAtTheClosedFormsShear) {
  const Eigen::Vector3d size(10, 8, 10);
  PlateUnderBlock strip(box_mesh(size, {2, 1, 2}), true);
  strip.press(2);
  const double area = size.x() * size.y();
  const auto height = [&] { return strip.state().x.back()(2, 0) - strip.state().x[0](2, 0); };
  const double stretch = height() / size.z();
  const double normal = 2 * kC1 * (std::pow(stretch, -3) - stretch) * area;
  // kappa/mu = 1e6 leaves the volume, and so the pressure, off by about 1e-6.
  EXPECT_NEAR(strip.force().z() / normal, 1, 1e-5);
  EXPECT_NEAR(strip.force().x(), 0, 1e-6 * normal);

  const double shear_limit = kCoefficient * (std::pow(stretch, -3) - stretch);
  const double drawn = 0.5 * shear_limit * size.z();
  strip.draw(drawn, 1);
  // Sticking: the plate's way is shear g H plus elastic slip s with μ t s/δ = 2c₁ g.
  const double elastic = kSlip / shear_limit;
  const double shear = drawn / (size.z() + elastic);
  EXPECT_NEAR(strip.force().x() / (2 * kC1 * shear * area), 1, 1e-4);
  EXPECT_LT(strip.force().x(), kCoefficient * strip.force().z());

  strip.draw(2 * shear_limit * size.z(), 2);
  EXPECT_NEAR(strip.force().x() / strip.force().z(), kCoefficient, 1e-5);
  EXPECT_NEAR(strip.force().x() / (2 * kC1 * shear_limit * area), 1, 1e-4);
  // Drawn back it sticks again, then slides the other way.
  strip.draw(-4 * shear_limit * size.z(), 4);
  EXPECT_NEAR(strip.force().x() / strip.force().z(), -kCoefficient, 1e-5);
}

// A block of finite length bulges over the plate, so nothing is homogeneous: but once all of it
// slides one way each point's friction is μ of its own pressure, so the sums obey F = μN whatever
// the pressures; and what the plate gives, the held top takes.
TEST(Friction, BlockSlidesAtMuTimesTheNormalForce) {
  PlateUnderBlock block(box_mesh({10, 8, 6}, {2, 2, 2}), false);
  block.press(1);
  block.draw(0.1, 1);
  EXPECT_LT(block.force().x(), 0.5 * kCoefficient * block.force().z()) << "it sticks";
  block.draw(20, 8);
  // Slips still turn a little towards x at the last steps: second order in the angle.
  EXPECT_NEAR(block.force().x() / block.force().z(), kCoefficient, 1e-3 * kCoefficient);
  EXPECT_NEAR((block.force() + block.top_force()).tail<1>().norm(), 0, 1e-4 * block.force().z());
  EXPECT_NEAR(block.force().x() + block.top_force().x(), 0, 1e-4 * block.force().z());
}

CompressionResult dome(double coefficient) {
  CompressionProblem problem = dome_problem(85);
  problem.mesh = dome_breast({4, 4, 1});
  problem.friction.coefficient = coefficient;
  return compress(problem, {});
}

TEST(Friction, HoldsTheSkinOfABreastBack) {
  const CompressionResult free = dome(0), rough = dome(0.3);
  ASSERT_TRUE(free.report.usable()) << free.report.reason;
  ASSERT_TRUE(rough.report.usable()) << rough.report.reason;
  EXPECT_NEAR(rough.report.thickness_mm, 85, 0.1);
  EXPECT_GT(rough.report.force_N, 1.01 * free.report.force_N);
  // The contact's sum and the potential's derivative share no code; as without friction.
  EXPECT_NEAR(rough.report.energy_force_N / rough.report.force_N, 1, 1e-3);
}

}  // namespace
}  // namespace mammotwin
