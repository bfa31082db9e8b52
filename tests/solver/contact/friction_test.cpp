#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "solver/contact/plate_friction.h"
#include "solver/material/neo_hookean.h"
#include "tests/solver/potential_laws.h"
#include "tests/solver/test_meshes.h"

namespace mammotwin {
namespace {

constexpr double kCoefficient = 0.3, kSlip = 0.1;

/// A block of 10 mm whose underside is 0.05 mm inside an endless plate.
struct PressedBlock {
  HermiteMesh mesh = box_mesh({10, 10, 10}, {1, 1, 1});
  Model model{mesh, uniform(std::make_shared<NeoHookean>(3)), {PressureSpace::trilinear, 1e4, 0}};
  std::shared_ptr<PlateContact> contact = std::make_shared<PlateContact>();
  std::shared_ptr<PlateFriction> friction =
      std::make_shared<PlateFriction>(contact, kCoefficient, kSlip);
  std::vector<std::pair<int, int>> faces{{0, 4}};
  State state = model.rest();

  PressedBlock() {
    contact->penalty = 20;  // pressure 1 kPa
    contact->plates = {Plate{{0, 0, 0.05}, {0, 0, 1}, {0, 1, 0}, 0, true}};
    model.add_surface_potential(0, 4, contact);
    model.add_surface_potential(0, 4, friction);
    friction->commit(model, state, faces);
  }
  void slide(double x, double y) {
    for (auto& node : state.x) node.col(0) += Eigen::Vector3d(x, y, 0);
  }
  Eigen::Vector3d force() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Face& face : model.faces(0))
      for (int q = 0; q < face.num_points(); ++q)
        sum += face.point(q).area *
               friction->traction(face.deformed(model.coefficients(state.x, 0), q).head<3>(),
                                  face.point(q), 0);
    return sum;
  }
};

// 1 kPa on 100 mm²: at most μ t A = 30 mN, times 2 s/δ − (s/δ)² below the slip δ.
TEST(PlateFriction, GrowsWithSlipUpToTheCoulombLimit) {
  PressedBlock block;
  block.slide(0.04, 0);
  EXPECT_NEAR((block.force() - Eigen::Vector3d(-19.2, 0, 0)).norm(), 0, 1e-9);
  block.slide(0.26, 0.4);
  EXPECT_NEAR((block.force() - Eigen::Vector3d(-18, -24, 0)).norm(), 0, 1e-9);
}

TEST(PlateFriction, KeepsItsForceOverACommitAndTurnsBackFromThere) {
  PressedBlock block;
  block.slide(0.5, 0);
  block.friction->commit(block.model, block.state, block.faces);
  EXPECT_NEAR(block.force().x(), -30, 1e-9);
  block.slide(-0.15, 0);  // 0.1 mm unloads the elastic slip, 0.05 mm more goes the other way
  EXPECT_NEAR(block.force().x(), 22.5, 1e-9);
}

TEST(PlateFriction, APlateThatMovesSidewaysTakesTheBlockAlong) {
  PressedBlock block;
  block.contact->plates[0].point += Eigen::Vector3d(0.05, 0, 0);
  EXPECT_NEAR(block.force().x(), 22.5, 1e-9);
}

TEST(PlateFriction, HistoryBringsAStepBack) {
  PressedBlock block;
  const auto before = block.friction->history();
  block.slide(1, 2);
  block.friction->commit(block.model, block.state, block.faces);
  block.slide(-1, -2);
  block.friction->restore(before);
  EXPECT_EQ(block.force(), Eigen::Vector3d::Zero());
}

TEST(PlateFriction, HoldsAPointThatSticksWhereItWas) {
  PressedBlock block;
  block.slide(0.04, 0);
  const auto holds = block.friction->holds(block.model, block.state, block.faces);
  block.friction->hold(holds, block.model, block.state, block.faces);
  EXPECT_NEAR((block.force() - Eigen::Vector3d(-19.2, 0, 0)).norm(), 0, 1e-9);
  block.slide(-0.04, 0);
  EXPECT_NEAR(block.force().norm(), 0, 1e-9);
}

TEST(PlateFriction, HoldsAPointThatSlidesWhereverThePlateIsPutThen) {
  PressedBlock block;
  block.slide(0.3, 0.4);
  block.friction->commit(block.model, block.state, block.faces);
  const auto holds = block.friction->holds(block.model, block.state, block.faces);
  block.contact->plates[0].point.x() += 5;
  block.friction->hold(holds, block.model, block.state, block.faces);
  EXPECT_NEAR((block.force() - Eigen::Vector3d(-18, -24, 0)).norm(), 0, 1e-9);
}

// 24 of at most 30 N; each 0.5 mm is a quarter of the reach, so a quarter of the 30.
TEST(PlateFriction, FrozenItKeepsItsForceAndGivesWayLikeASpring) {
  PressedBlock block;
  block.slide(0, -0.055278640450004204);  // where the elastic slip bears 0.8 of the limit
  block.friction->freeze(2, block.model, block.state, block.faces);
  EXPECT_NEAR((block.force() - Eigen::Vector3d(0, 24, 0)).norm(), 0, 1e-9);
  block.slide(0.5, 0);
  block.friction->track(block.model, block.state, block.faces);
  block.friction->commit(block.model, block.state, block.faces);
  const Eigen::Vector3d moved = block.force();
  EXPECT_NEAR((moved - Eigen::Vector3d(-7.5, 24, 0)).norm(), 0, 1e-9);
  const auto holds = block.friction->holds(block.model, block.state, block.faces);
  block.friction->hold(holds, block.model, block.state, block.faces);
  block.friction->freeze(2, block.model, block.state, block.faces);
  EXPECT_NEAR((block.force() - moved).norm(), 0, 1e-9);
}

TEST(PlateFriction, RefusesAHoldOfAnotherMesh) {
  PressedBlock block;
  EXPECT_THROW(
      block.friction->hold({{1000, 0, {0, 0, 0}, 1}}, block.model, block.state, block.faces),
      std::invalid_argument);
}

TEST(PlateFriction, ForgetsWhereAPointStoodThatLeftThePlate) {
  PressedBlock block;
  block.slide(0.5, 0);
  for (auto& node : block.state.x) node.col(0).z() += 1;
  block.friction->commit(block.model, block.state, block.faces);
  for (auto& node : block.state.x) node.col(0).z() -= 1;
  block.friction->track(block.model, block.state, block.faces);
  EXPECT_NEAR(block.force().norm(), 0, 1e-12);
}

TEST(PlateFriction, GradientAndHessianAreDerivativesSymmetricAndSemidefinite) {
  PressedBlock block;
  SurfacePoint point = block.model.faces(0)[0].point(7);
  for (const Eigen::Vector3d& slip :
       {Eigen::Vector3d(0.03, -0.05, 0), Eigen::Vector3d(0.4, 0.3, 0)}) {
    Eigen::Matrix<double, 9, 1> y = Eigen::Matrix<double, 9, 1>::Zero();
    y.head<3>() = point.X + slip;
    expect_consistent(*block.friction, y, point);
    SurfaceResponse response;
    ASSERT_TRUE(block.friction->respond(y, point, 2, response));
    const Eigen::Matrix3d H = response.hessian.topLeftCorner<3, 3>();
    EXPECT_GE(H.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12);
  }
}

// With pressures brought up to each place the force's derivative is hessian and circulation.
TEST(PlateFriction, CirculationIsWhatTrackedPressuresAddToTheHessian) {
  constexpr double h = 1e-5;  // [mm]: second differences leave 1e-10 of third derivatives
  for (const Eigen::Vector3d& slip :
       {Eigen::Vector3d(0.03, -0.05, 0), Eigen::Vector3d(0.4, 0.3, 0)}) {
    PressedBlock block;
    block.slide(slip.x(), slip.y());
    const SurfacePoint point = block.model.faces(0)[0].point(7);
    const auto respond = [&] {
      Eigen::Matrix<double, 9, 1> y = Eigen::Matrix<double, 9, 1>::Zero();
      y.head<3>() = point.X + block.state.x[0].col(0) - block.mesh.node(0).col(0);
      SurfaceResponse response;
      block.friction->track(block.model, block.state, block.faces);
      EXPECT_TRUE(block.friction->respond(y, point, 2, response));
      Eigen::Matrix3d circulation;
      EXPECT_TRUE(block.friction->circulation(y, point, circulation));
      return std::pair(response, circulation);
    };
    const auto [here, circulation] = respond();
    const Eigen::Matrix3d derivative = here.hessian.topLeftCorner<3, 3>() + circulation;
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d ahead = Eigen::Vector3d::Zero();
      ahead[k] = h;
      for (auto& node : block.state.x) node.col(0) += ahead;
      const Eigen::Vector3d plus = respond().first.gradient.head<3>();
      for (auto& node : block.state.x) node.col(0) -= 2 * ahead;
      const Eigen::Vector3d minus = respond().first.gradient.head<3>();
      for (auto& node : block.state.x) node.col(0) += ahead;
      EXPECT_NEAR(((plus - minus) / (2 * h) - derivative.col(k)).norm(), 0,
                  1e-6 * derivative.norm())
          << k;
    }
    EXPECT_GT((circulation - circulation.transpose()).norm(), 0.01 * derivative.norm());
  }
}

Eigen::Matrix3d hessian_at(const PressedBlock& block, const SurfacePoint& point) {
  Eigen::Matrix<double, 9, 1> y = Eigen::Matrix<double, 9, 1>::Zero();
  y.head<3>() = point.X + block.state.x[0].col(0) - block.mesh.node(0).col(0);
  SurfaceResponse response;
  EXPECT_TRUE(block.friction->respond(y, point, 2, response));
  return response.hessian.topLeftCorner<3, 3>();
}

// A step of no length leaves the share the state's own.
TEST(PlateFriction, InASolveTheHessianIsTheExactOneOnceTheShapeRests) {
  for (const Eigen::Vector2d& slip : {Eigen::Vector2d(0.03, -0.05), Eigen::Vector2d(0.4, 0.3)}) {
    PressedBlock block;
    block.slide(slip.x(), slip.y());
    const SurfacePoint point = block.model.faces(0)[0].point(7);
    const Eigen::Matrix3d exact = hessian_at(block, point);
    const State before = block.state;
    block.slide(0.2, 0.1);
    block.friction->step(block.model, before, block.state, block.faces);
    EXPECT_GT((hessian_at(block, point) - exact).norm(), 1e-3 * exact.norm()) << "it moved";
    block.slide(-0.2, -0.1);
    for (int k = 0; k < 2; ++k)  // one step back, one of no length
      block.friction->step(block.model, block.state, block.state, block.faces);
    EXPECT_NEAR((hessian_at(block, point) - exact).norm(), 0, 1e-12 * exact.norm());
    block.friction->align();
    EXPECT_NEAR((hessian_at(block, point) - exact).norm(), 0, 1e-12 * exact.norm());
  }
}

TEST(PlateFriction, InASolveTheHessianStaysSemidefiniteWhereverSlipTurns) {
  PressedBlock block;
  const SurfacePoint point = block.model.faces(0)[0].point(7);
  std::mt19937 random(5);
  std::normal_distribution<double> step(0, 2 * kSlip);
  for (int k = 0; k < 50; ++k) {
    const State before = block.state;
    block.slide(step(random), step(random));
    block.friction->step(block.model, before, block.state, block.faces);
    const Eigen::Matrix3d H = hessian_at(block, point);
    EXPECT_NEAR((H - H.transpose()).norm(), 0, 1e-12 * H.norm());
    EXPECT_GE(H.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12 * H.norm());
  }
}

// Sliding at 0.3 mm along x, then thrown to the other side of its anchor: w = (1, 0) by the linear
// step, for w D = s along its own direction asks for nothing else. The hessian is then
// μ t/s (I − n nᵀ + x xᵀ): 2 μ t/s along x where the exact one has none.
TEST(PlateFriction, ThrownPastItsAnchorAPointIsHeldBackByTwiceItsForceOverItsWay) {
  PressedBlock block;
  block.slide(0.3, 0);
  const State before = block.state;
  block.slide(-0.5, 0);
  block.friction->step(block.model, before, block.state, block.faces);
  const Eigen::Matrix3d H = hessian_at(block, block.model.faces(0)[0].point(7));
  EXPECT_NEAR(H(0, 0), 2 * kCoefficient / 0.2, 1e-9);
  EXPECT_NEAR(H(1, 1), kCoefficient / 0.2, 1e-9);
}

// Newton's model of it is as good on one side of the limit as on the other.
TEST(PlateFriction, StiffnessDoesNotJumpWhereSlidingBegins) {
  PressedBlock block;
  const SurfacePoint point = block.model.faces(0)[0].point(7);
  const auto stiffness = [&](double slip) {
    Eigen::Matrix<double, 9, 1> y = Eigen::Matrix<double, 9, 1>::Zero();
    y.head<3>() = point.X + Eigen::Vector3d(slip, 0, 0);
    SurfaceResponse response;
    EXPECT_TRUE(block.friction->respond(y, point, 2, response));
    return response.hessian.topLeftCorner<3, 3>().eval();
  };
  // Curvature 2 (1 − s/δ) μ t/δ: 1e-6 of the whole at 1e-6 of δ.
  EXPECT_NEAR((stiffness(kSlip * (1 - 1e-6)) - stiffness(kSlip * (1 + 1e-6))).norm(), 0,
              1e-5 * kCoefficient / kSlip);
}

TEST(PlateFriction, RefusesACoefficientOrASlipOutOfRange) {
  const auto contact = std::make_shared<PlateContact>();
  EXPECT_THROW(PlateFriction(contact, -0.1, 0.1), std::invalid_argument);
  EXPECT_THROW(PlateFriction(contact, 1.1, 0.1), std::invalid_argument);
  EXPECT_THROW(PlateFriction(contact, 0.3, 0), std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin
