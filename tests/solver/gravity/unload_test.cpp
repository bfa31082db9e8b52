#include "solver/gravity/unload.h"

#include <gtest/gtest.h>

#include <limits>

#include "solver/element/skin_membrane.h"
#include "solver/load/spring_bed.h"
#include "solver/load/wall_surface.h"
#include "solver/material/exponential.h"
#include "solver/material/mooney_rivlin.h"
#include "solver/material/neo_hookean.h"
#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

const Eigen::Vector3d kBodyForce(2e-3, -9.81e-3, 1e-3);  // [mN/mm³]

/// One element whose reference shape can be changed, with everything that may hold a breast on one
/// of its faces; x and p stay.
struct Changeable {
  HermiteMesh start = distorted(box_mesh({10, 12, 9}, {1, 1, 1}), 0.4, 1);
  std::vector<HermiteMesh::Node> X = start.nodes();
  State state{distorted(start, 0.5, 2).nodes(), {0.3, 0.2, 0.1, 0, -0.1, -0.2, -0.3, -0.4}};
  std::shared_ptr<const Material> law;
  std::shared_ptr<const SurfacePotential> potential;

  Model model() const {
    Model model(HermiteMesh(X, start.elements()), uniform(law), {PressureSpace::trilinear, 50, 5});
    model.set_body_force(uniform_force(kBodyForce));
    if (potential) model.add_surface_potential(0, 4, potential);
    return model;
  }
  double& unknown(int k) {
    const int a = k % kFunctions;
    return X[start.corners(0)[corner_of_function(a)]](k / kFunctions, parameter_of_function(a));
  }
};

/// Both residuals by central differences over every unknown of X. At h = 1e-5 mm they are good to
/// 1e-7 of the largest derivative.
void expect_consistent(Changeable one) {
  constexpr double h = 1e-5;
  ReferenceSystem exact;
  one.model().evaluate_reference(0, one.state, kBodyForce, exact);
  const double scale = exact.tangent.cwiseAbs().maxCoeff();
  for (int k = 0; k < kUnknowns; ++k) {
    const double kept = one.unknown(k);
    ElementSystem plus, minus;
    one.unknown(k) = kept + h;
    one.model().evaluate(0, one.state, TangentKind::none, plus);
    one.unknown(k) = kept - h;
    one.model().evaluate(0, one.state, TangentKind::none, minus);
    one.unknown(k) = kept;
    const auto force = ((plus.residual - minus.residual) / (2 * h)).eval();
    const auto volume = ((plus.pressure_residual - minus.pressure_residual) / (2 * h)).eval();
    EXPECT_NEAR((force - exact.tangent.col(k)).cwiseAbs().maxCoeff(), 0, 1e-7 * scale) << k;
    EXPECT_NEAR((volume - exact.pressure_tangent.col(k)).cwiseAbs().maxCoeff(), 0, 1e-6 * scale)
        << k;
  }
}

TEST(ReferenceTangent, IsTheResidualsDerivativeByTheReferenceShape) {
  Changeable one;
  one.law = std::make_shared<MooneyRivlin>(0.8, 0.2);
  expect_consistent(one);
}

TEST(ReferenceTangent, HoldsForAStiffeningLaw) {
  Changeable one;
  one.law = std::make_shared<Exponential>(0.8, 1.5);
  expect_consistent(one);
}

TEST(ReferenceTangent, CouplingIsThatOfTheForwardProblem) {
  Changeable one;
  one.law = std::make_shared<NeoHookean>(0.8);
  ReferenceSystem reference;
  ElementSystem forward;
  one.model().evaluate_reference(0, one.state, kBodyForce, reference);
  one.model().evaluate(0, one.state, TangentKind::exact, forward);
  EXPECT_NEAR((reference.coupling - forward.coupling).norm(), 0, 1e-10 * forward.coupling.norm());
}

// Stiff beside the tissue, so that an error in the face's part cannot hide in the element's.
TEST(ReferenceTangent, HoldsWithSkin) {
  Changeable one;
  one.law = std::make_shared<NeoHookean>(0.01);
  for (const double stiffening : {0.0, 2.0}) {
    one.potential = std::make_shared<SkinMembrane>(3.3, 1.5, stiffening);
    expect_consistent(one);
  }
}

TEST(ReferenceTangent, HoldsWithSprings) {
  Changeable one;
  one.law = std::make_shared<NeoHookean>(0.01);
  for (const double reach : {1.0, std::numeric_limits<double>::infinity()}) {
    one.potential = std::make_shared<SpringBed>(0.5, reach);
    expect_consistent(one);
  }
}

TEST(ReferenceTangent, HoldsOnAWall) {
  Changeable one;
  one.law = std::make_shared<NeoHookean>(0.01);
  const HermiteMesh around = bent(box_mesh({40, 40, 10}, {1, 1, 1}), 3);
  auto nodes = around.nodes();
  for (auto& node : nodes) node.col(0) -= Eigen::Vector3d(15, 15, 1);
  const HermiteMesh wall(nodes, around.elements());
  one.potential = std::make_shared<WallHold>(
      std::make_shared<WallSurface>(wall, std::vector<std::pair<int, int>>{{0, 4}}), 3,
      WallRest::as_reference);
  expect_consistent(one);
}

TEST(ReferenceTangent, RefusesALoadThatCannotSay) {
  Changeable one;
  one.law = std::make_shared<NeoHookean>(0.8);
  class Silent : public SurfacePotential {
    Slots slots() const override { return kPosition; }
    bool respond(const Eigen::Matrix<double, 9, 1>&, const SurfacePoint&, int,
                 SurfaceResponse&) const override {
      return true;
    }
  };
  one.potential = std::make_shared<Silent>();
  ReferenceSystem system;
  EXPECT_THROW(one.model().evaluate_reference(0, one.state, kBodyForce, system), std::logic_error);
}

/// A dome of lumpy tissue that hangs under gravity times `pull`, its skin and walls as by default.
BreastProblem hanging_dome(double pull) {
  BreastProblem problem = dome_problem(60);
  problem.mesh = dome_breast({3, 3, 1});
  problem.gravity = {0, -9810 * pull, 0};
  return problem;
}

// Newton stops at 1e-10 of the forces, and a breast yields about 1 mm to a force that it feels.
TEST(Unload, ReloadedTheBreastHangsAsItDid) {
  const UnloadResult result = unload(hanging_dome(5), {});
  const UnloadReport& report = result.report;
  ASSERT_TRUE(report.usable()) << report.reason;
  EXPECT_GT(report.sag_max_mm, 3);
  EXPECT_LT(report.round_trip_max_mm, 1e-6);
  ASSERT_TRUE(report.naive_reversal_error_mm);
  EXPECT_GT(*report.naive_reversal_error_mm, 0.01);
}

TEST(Unload, WithoutGravityTheShapeIsTheImagedOne) {
  BreastProblem problem = hanging_dome(0);
  const UnloadResult result = unload(problem, {});
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  EXPECT_EQ(result.report.sag_max_mm, 0);
  EXPECT_EQ(result.report.newton_iterations, 0);
}

/// Pressed from both sides, as by a coil's plates: without them the skin there goes outward, so
/// their forces would do negative work on the way.
TEST(Unload, TakesPressureOnTheSkinOff) {
  BreastProblem problem = hanging_dome(2);
  const UnloadResult hung = unload(problem, {});
  problem.skin_forces =
      forces_of_pressure(problem.mesh, [](const Eigen::Vector3d&, const Eigen::Vector3d& outward) {
        return 0.3 * std::abs(outward.x());
      });
  const UnloadResult pressed = unload(problem, {});
  ASSERT_TRUE(hung.report.usable() && pressed.report.usable()) << pressed.report.reason;
  EXPECT_LT(pressed.report.round_trip_max_mm, 1e-6) << "hung up and pressed again";
  double work = 0, size = 0;  // [mN mm]
  const HermiteMesh& mesh = problem.mesh.mesh;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int a = 0; a < kFunctions; ++a) {
      const int node = mesh.corners(e)[corner_of_function(a)];
      const Eigen::Vector3d way =
          (pressed.unloaded[node] - hung.unloaded[node]).col(parameter_of_function(a));
      const Eigen::Vector3d force = problem.skin_forces[e].row(a);
      work += force.dot(way), size += force.norm() * way.norm();
    }
  EXPECT_LT(work, -0.2 * size);
}

TEST(Unload, AClampedWallStaysWhereItIs) {
  BreastProblem problem = hanging_dome(5);
  problem.boundary.chest_wall = ChestWall::clamped;
  const UnloadResult result = unload(problem, {});
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  EXPECT_LT(result.report.round_trip_max_mm, 1e-6);
  const HermiteMesh& prone = problem.mesh.mesh;
  for (int corner = 0; corner < 4; ++corner) {  // ξ₃ = 0 is the wall
    const int node = prone.corners(0)[corner];
    EXPECT_EQ((result.unloaded[node].col(0) - prone.node(node).col(0)).norm(), 0);
  }
}

}  // namespace
}  // namespace mammotwin
