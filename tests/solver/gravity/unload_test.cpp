#include "solver/gravity/unload.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "solver/breast/breast_model.h"
#include "solver/element/element_coefficients.h"
#include "solver/element/skin_membrane.h"
#include "solver/gravity/fit_skin_way.h"
#include "solver/gravity/pressing_springs.h"
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

/// The dome's sides, as if a coil's plates had pressed them.
PressedSkin pressed_sides(double way_mm) {
  PressedSkin pressed;
  pressed.way_mm = way_mm;
  pressed.at = [](const Eigen::Vector3d&, const Eigen::Vector3d& normal) {
    PressedSkin::Point point;
    point.outward = normal.x() > 0 ? Eigen::Vector3d::UnitX() : (-Eigen::Vector3d::UnitX()).eval();
    point.share = point.way = std::clamp(2 * std::abs(normal.x()) - 0.5, 0.0, 1.0);
    return point;
  };
  return pressed;
}

/// How far the sides of one shape lie outward of those of another, weighed by share [mm].
double outward_way(const BreastProblem& problem, const std::vector<HermiteMesh::Node>& from,
                   const std::vector<HermiteMesh::Node>& to) {
  double sum = 0, weight = 0;
  const HermiteMesh& mesh = problem.mesh.mesh;
  for (const auto& [e, side] : faces_labelled(problem.mesh, FaceLabel::skin)) {
    const Face face(e, side, element_coefficients(mesh, mesh.nodes(), e), 8);
    for (int q = 0; q < face.num_points(); ++q) {
      const SurfacePoint& point = face.point(q);
      const PressedSkin::Point pressed = problem.pressed.at(point.X, point.normal);
      const Eigen::Vector3d way = (face.deformed(element_coefficients(mesh, to, e), q) -
                                   face.deformed(element_coefficients(mesh, from, e), q))
                                      .head<3>();
      sum += pressed.share * point.area * pressed.outward.dot(way);
      weight += pressed.share * point.area;
    }
  }
  return sum / weight;
}

TEST(Unload, PressedSkinGoesOutwardAndComesBack) {
  BreastProblem problem = hanging_dome(2);
  const std::vector<HermiteMesh::Node>& imaged = problem.mesh.mesh.nodes();
  double way = 0, force_N = 0;
  for (const double way_mm : {2.0, 4.0}) {
    problem.pressed = pressed_sides(way_mm);
    const UnloadResult result = unload(problem, {});
    ASSERT_TRUE(result.report.usable()) << result.report.reason;
    EXPECT_LT(result.report.round_trip_max_mm, 1e-6) << "hung up and pressed again";
    EXPECT_GT(outward_way(problem, imaged, result.unloaded), way + 0.7);
    EXPECT_GT(result.report.skin_force_N, force_N + 0.1);
    way = outward_way(problem, imaged, result.unloaded);
    force_N = result.report.skin_force_N;
  }
}

TEST(FitSkinWay, FindsTheWayToAFigureOrSaysHowFarItCame) {
  BreastProblem problem = hanging_dome(2);
  problem.pressed = pressed_sides(0);
  const std::vector<HermiteMesh::Node> imaged = problem.mesh.mesh.nodes();
  const auto outward = [&](const auto& shape) { return outward_way(problem, imaged, shape); };
  const SkinWayFit fit = fit_skin_way(problem, outward, 3, {});
  EXPECT_EQ(fit.reason, "");
  EXPECT_NEAR(fit.figure, 3, 0.01);
  problem.pressed.way_mm = fit.way_mm;
  EXPECT_NEAR(outward(unload(problem, {}).unloaded), fit.figure, 1e-5);

  const SkinWayFit too_far = fit_skin_way(problem, outward, 300, {});
  EXPECT_NE(too_far.reason, "");
  EXPECT_GT(too_far.figure, 3);
  EXPECT_LT(too_far.figure, 300);
}

TEST(PressingSprings, ForcesAreTheResidualThatTheyLeaveAndItsDerivative) {
  BreastProblem problem = hanging_dome(1);
  problem.pressed = pressed_sides(3);
  const PressingSprings springs(problem, 0.4);
  const HermiteMesh& mesh = problem.mesh.mesh;
  EXPECT_GT(springs.force_N(mesh, 3), 0);
  EXPECT_EQ(springs.force_N(mesh, 0), 0) << "the imaged shape asks for none";
  const HermiteMesh X = distorted(mesh, 0.5, 3);
  const DeadForces forces = springs.forces(X, 3);
  constexpr double h = 1e-4;
  int pressed = 0;
  for (int e = 0; e < mesh.num_elements(); ++e) {
    const SolidElement::Coefficients at = element_coefficients(X, X.nodes(), e);
    ElementSystem here, there;
    ReferenceSystem reference;
    here.residual.setZero();
    there.residual.setZero();
    reference.tangent.setZero();
    springs.add(e, at, 3, &here, &reference);
    EXPECT_EQ((here.residual + forces[e].reshaped()).norm(), 0) << e;
    SolidElement::Coefficients direction = SolidElement::Coefficients::Random();
    springs.add(e, at + h * direction, 3, &there, nullptr);
    const Eigen::VectorXd change = (there.residual - here.residual) / h;  // linear
    EXPECT_NEAR((change - reference.tangent * direction.reshaped()).norm(), 0,
                1e-6 * (1 + change.norm()));
    pressed += change.norm() > 0;
  }
  EXPECT_GT(pressed, 0);
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

/// A dome that hangs from a wall with a bump of 6 mm in its middle, on which tissue slides freely.
BreastProblem dome_on_a_bump() {
  BreastProblem problem = hanging_dome(13.5);
  problem.mesh = dome_breast({4, 4, 1});
  std::vector<HermiteMesh::Node> nodes = problem.mesh.mesh.nodes();
  const auto middle = std::find_if(nodes.begin(), nodes.end(), [](const HermiteMesh::Node& node) {
    return node.col(0).norm() < 1e-9;
  });
  (*middle)(1, 0) -= 6;
  problem.mesh.mesh = HermiteMesh(nodes, problem.mesh.mesh.elements());
  problem.boundary.chest_wall_spring = 1e-5;
  problem.boundary.wall_smoothing = 0;
  return problem;
}

TEST(Unload, WhereTissueRollsALittleOffABumpTheBreastIsNotTakenToBeStiffer) {
  const BreastProblem problem = dome_on_a_bump();
  const UnloadResult near = unload(problem, {});
  EXPECT_TRUE(near.report.usable()) << near.report.reason;
  EXPECT_EQ(near.report.stability_margin, 0) << "the imaged shape is no minimum";
  EXPECT_GT(near.report.round_trip_rms_mm, 0.1);
  EXPECT_LT(near.report.round_trip_rms_mm, 1);
  EXPECT_GE(near.report.round_trip_max_mm, near.report.round_trip_rms_mm);

  UnloadOptions exactly;
  exactly.rest_tolerance = 1e-3;
  const UnloadReport part = unload(problem, exactly).report;
  EXPECT_FALSE(part.usable());
  EXPECT_LT(part.gravity_fraction, 1);
  EXPECT_GT(part.stability_margin, 0);
  EXPECT_LT(part.round_trip_rms_mm, 1e-3);
}

}  // namespace
}  // namespace mammotwin
