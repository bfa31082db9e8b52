#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "registration/search/reduced_view.h"
#include "registration/view/view_of_plates.h"
#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

/// A dome between plates that three of the state's numbers move; a fourth widens it free of load.
CompressionProblem dome_at(const ViewState& state) {
  CompressionProblem problem = dome_problem(85 + state[kThickness]);
  problem.mesh = dome_breast({2, 2, 1});
  problem.prone = problem.mesh.mesh.nodes();
  Nodes wider = problem.prone;
  for (HermiteMesh::Node& node : wider) node.row(0) *= 1 + state[kCoilRoundness];
  problem.mesh.mesh = HermiteMesh(wider, problem.mesh.mesh.elements());
  problem.plates.lift = state[kLift];
  problem.plates.wall_clearance += state[kClearance];
  return problem;
}

NearbySolver dome_solver() {
  const CompressionProblem problem = dome_at(ViewState::Zero());
  CompressionOptions options;
  options.gap_tolerance = 0.1;
  options.thickness_tolerance = 1;  // what it comes to is enough here
  const CompressionResult result = compress(problem, options);
  EXPECT_TRUE(result.report.usable()) << result.report.reason;
  return NearbySolver({result, view_of_plates("cc", Side::left, 0, 0, problem.plates, result)},
                      dome_at);
}

double largest(const Nodes& nodes) {
  double size = 0;
  for (const HermiteMesh::Node& node : nodes) size = std::max(size, node.col(0).norm());
  return size;
}

// Against solves 0.002 mm to either side: the same derivative, as NearbyEquilibria's test has it,
// here with the view's frame that moves with the plates.
TEST(NearbySolver, SlopesAreWhatSolvesSay) {
  const NearbySolver solver = dome_solver();
  const ViewState sd = ViewState::Constant(0.002);
  const auto slopes = solver.slopes(sd);
  ASSERT_TRUE(slopes);
  for (const int i : {kThickness, kClearance, kCoilRoundness}) {
    const auto up = solver.solve(sd[i] * ViewState::Unit(i));
    const auto down = solver.solve(-sd[i] * ViewState::Unit(i));
    ASSERT_TRUE(up && down) << kStateNames[i];
    const Nodes above = in_view(up->result.deformed, up->view.frame);
    const Nodes below = in_view(down->result.deformed, down->view.frame);
    Nodes off = (*slopes)[i];
    for (std::size_t n = 0; n < off.size(); ++n) off[n] -= (above[n] - below[n]) / 2;
    EXPECT_GT(largest((*slopes)[i]), 0.0006) << kStateNames[i];
    EXPECT_LT(largest(off), 0.01 * largest((*slopes)[i])) << kStateNames[i];
  }
  EXPECT_EQ(largest((*slopes)[kTilt]), 0);  // of which dome_at knows nothing
}

// Far from the chest wall and on weak springs, 5 mm thinner: what then stays between the plates is
// less than half of the tissue. A search has to be able to go there. It slides back by a sixth of
// its tissue between 4 and 5 mm; beyond 6 mm it is found in steps of 0.5 mm only, and from 7 mm on
// not at all.
TEST(NearbySolver, GoesOnWhereTheBreastSlipsBackwards) {
  const auto loose_at = [](const ViewState& state) {
    CompressionProblem problem = dome_problem(36 + state[kThickness], false);
    problem.mesh = dome_breast({2, 2, 1});
    problem.plates.wall_clearance = 20;
    return problem;
  };
  const CompressionProblem problem = loose_at(ViewState::Zero());
  CompressionOptions options;
  options.gap_tolerance = 0.1;
  options.thickness_tolerance = 1;
  options.least_retained = 0;
  const CompressionResult result = compress(problem, options);
  ASSERT_TRUE(result.report.usable()) << result.report.reason;
  EXPECT_GT(result.report.retained_fraction, 0.5);
  const NearbySolver solver(
      {result, view_of_plates("cc", Side::left, 0, 0, problem.plates, result)}, loose_at);
  const auto thinner = solver.solve(-5 * ViewState::Unit(kThickness));
  ASSERT_TRUE(thinner);
  EXPECT_LT(thinner->result.report.retained_fraction, 0.5);
  const auto apart = [](const PlacedPlates& p) { return p.paddle_height - p.support_height; };
  EXPECT_NEAR(apart(thinner->result.plates), apart(result.plates) - 5, 1e-9);
}

// However the outline's two ends fall at another angle: plates that say 5 mm more of their middle.
TEST(NearbySolver, KeepsTheBreastsMiddleInItsPlaceAtEveryAngle) {
  const NearbySolver solver = dome_solver();
  const CompressionResult& base = solver.base().result;
  const auto along_edge = [&](const ViewFrame& frame) {
    Nodes nodes = in_view(base.deformed, frame);
    double sum = 0;
    for (const HermiteMesh::Node& node : nodes) sum += node(1, 0);
    return sum / static_cast<double>(nodes.size());
  };
  for (const double roll : {0.0, 0.1, -10.0}) {
    const ViewState state = roll * ViewState::Unit(kRoll);
    PlateOptions plates = dome_at(state).plates;
    const Eigen::Matrix3d axes = view_axes(Side::left, roll);
    plates.depth = axes.row(0);
    plates.up = axes.row(2);
    CompressionResult result = base;
    result.plates.lateral_middle += 5;
    EXPECT_NEAR(along_edge(solver.view_at(state, plates, result).frame),
                along_edge(solver.base().view.frame), 1e-9)
        << roll;
  }
}

TEST(NearbySolver, KeepsThePlatesTurnAtEveryAngle) {
  SolvedView base = dome_solver().base();
  base.view.turn_deg = -20;
  base.view.frame.axes = axes_of(Side::left, 0, -20);
  const NearbySolver solver(base, dome_at);
  const PlateOptions plates = dome_at(ViewState::Zero()).plates;
  const CompressedView view = solver.view_at(5 * ViewState::Unit(kRoll), plates, base.result);
  EXPECT_EQ(view.turn_deg, -20);
  EXPECT_EQ(view.frame.axes, axes_of(Side::left, 5, -20));
}

// A thickness more than 2 mm above the base cannot be posed, so its sample is the one at half of
// the standard deviation of 4 mm. The quadratic still goes through all that was solved.
TEST(ReducedView, TakesWhatIsFoundNearerToTheBase) {
  const NearbySolver whole = dome_solver();
  const NearbySolver solver(whole.base(), [](const ViewState& state) {
    if (state[kThickness] > 2) throw std::invalid_argument("too thick");
    if (state.norm() != std::abs(state[kThickness]))
      throw std::invalid_argument("not asked for here");
    return dome_at(state);
  });
  ReducedView view = reduce_view(solver, prior_sd());
  EXPECT_EQ(view.failed_solves, 2 * (kMechanical - 1));
  view.base = in_view(solver.soft_base()->result.deformed, solver.soft_base()->view.frame);
  for (const double z : {0.5, -1.0}) {
    const auto solved = whole.solve(prior_sd()[kThickness] * z * ViewState::Unit(kThickness));
    ASSERT_TRUE(solved);
    Nodes off = view.nodes_at(z * ViewState::Unit(kThickness));
    const Nodes there = in_view(solved->result.deformed, solved->view.frame);
    for (std::size_t n = 0; n < off.size(); ++n) off[n] -= there[n];
    EXPECT_LT(largest(off), 1e-9) << z;  // the same solve
  }
}

TEST(LinearView, IsTheBaseAndItsSlopes) {
  const NearbySolver solver = dome_solver();
  const ReducedView view = linear_view(solver, prior_sd());
  EXPECT_EQ(view.failed_solves, 0);
  ViewState z = ViewState::Zero();
  z[kThickness] = 1;
  Nodes moved = view.nodes_at(z);
  for (std::size_t n = 0; n < moved.size(); ++n) moved[n] -= view.base[n];
  EXPECT_GT(largest(moved), 0.5);  // plates 3 mm farther apart
  EXPECT_LT(largest(moved), 10);
}

TEST(LinearView, LeavesOutANumberThatTheBreastHasNot) {
  ViewState sd = prior_sd();
  sd[kCoilRoundness] = 0;
  const ReducedView view = linear_view(dome_solver(), sd);
  EXPECT_EQ(view.failed_solves, 0);
  EXPECT_TRUE(view.modes[kCoilRoundness].linear.empty());
  EXPECT_FALSE(view.modes[kFriction].linear.empty());
}

// A quadratic's slope is its central difference, whatever the step.
TEST(ReducedView, SlopeIsTheCentralDifference) {
  ReducedView view;
  view.base = {HermiteMesh::Node::Constant(1)};
  view.modes[kRoll] = {{HermiteMesh::Node::Constant(2)}, {HermiteMesh::Node::Constant(0.5)}};
  view.modes[kLift] = {{HermiteMesh::Node::Constant(-3)}, {HermiteMesh::Node::Constant(4)}};
  ViewState z = ViewState::Zero();
  z[kRoll] = 1.5;
  z[kLift] = -0.4;
  const Nodes up = view.nodes_at(z + 0.3 * ViewState::Unit(kRoll));
  const Nodes down = view.nodes_at(z - 0.3 * ViewState::Unit(kRoll));
  const Nodes expected = {view.nodes_at(z)[0] + (up[0] - down[0]) / 0.6};
  EXPECT_LT((view.nodes_along_slope(z, kRoll)[0] - expected[0]).norm(), 1e-12);
}

}  // namespace
}  // namespace mammotwin
