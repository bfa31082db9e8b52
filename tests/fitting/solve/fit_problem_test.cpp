#include "fitting/solve/fit_problem.h"

#include <gtest/gtest.h>

#include "fitting/mesh/jacobian_bound.h"
#include "tests/fitting/flat_target.h"

namespace mammotwin {
namespace {

TEST(FitPoint, CondensedResidualsHaveTheCostsGradientAndHessian) {
  FlatTarget flat({2, 2, 1}, 3);
  FitPoint point(flat.slab, flat.box, flat.target);
  point.model().weigh(0.5, 1e-6);
  point.move_to(flat.box.nodes());
  const double squared = std::pow(point.remaining_residual(), 2);
  point.linearise();
  double sum = std::pow(point.remaining_residual(), 2);
  for (int e = 0; e < 4; ++e) {
    const FitPoint::Condensed& element = point.condensed(e);
    const ElementMatrix L = element.factor.triangularView<Eigen::Lower>();
    const ElementQuadratic expected = point.model().quadratic(e);
    // The diagonal's shift is 1e-9 of it.
    EXPECT_LT((L * element.residuals - expected.gradient).norm(), 1e-8 * expected.gradient.norm());
    EXPECT_LT((L * L.transpose() - expected.hessian).norm(), 1e-8 * expected.hessian.norm());
    sum += element.residuals.squaredNorm();
  }
  EXPECT_NEAR(sum, squared, 1e-12 * squared);
}

TEST(FitProblem, PullsASheetToItsTargetAndKeepsWhatIsHeld) {
  FlatTarget flat({2, 2, 1}, 2);
  FitPoint point(flat.slab, flat.box, flat.target);
  point.model().weigh(1e-3, 1e-8);
  std::vector<HermiteMesh::Node> nodes = flat.box.nodes();
  const HeldParameters held = held_parameters(flat.slab);
  FitProblem problem(point, flat.box.elements(), held, nodes);
  ceres::Solver::Options options = FitProblem::options();
  options.max_num_iterations = 10;
  const ceres::Solver::Summary summary = problem.solve(options);
  EXPECT_TRUE(summary.IsSolutionUsable()) << summary.FullReport();
  const HermiteMesh moved(nodes, flat.box.elements());
  for (double a : {0.0, 0.3, 1.0})
    EXPECT_NEAR(moved.position({0, {a, 0.6, 1}}).y(), flat.skin_y(), 0.01);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (int p = 0; p < 24; ++p) {
      if (!held[n][p]) continue;
      EXPECT_EQ(nodes[n].data()[p], flat.box.node(static_cast<int>(n)).data()[p]);
    }
}

// Skin pulled far behind the wall, with hardly any shape energy: without the demand the mesh folds.
TEST(FitProblem, StepsToAMeshThatIsNotProvedDoNotCount) {
  for (const MeshDemand demand : {MeshDemand::none, MeshDemand::proved}) {
    FlatTarget flat({2, 2, 1}, -30);
    FitPoint point(flat.slab, flat.box, flat.target);
    point.model().weigh(1e-6, 1e-8);
    point.demand(demand, flat.box);
    std::vector<HermiteMesh::Node> nodes = flat.box.nodes();
    FitProblem problem(point, flat.box.elements(), held_parameters(flat.slab), nodes);
    ceres::Solver::Options options = FitProblem::options();
    options.max_num_iterations = 30;
    problem.solve(options);
    EXPECT_EQ(proved_valid(HermiteMesh(nodes, flat.box.elements())), demand == MeshDemand::proved);
  }
}

}  // namespace
}  // namespace mammotwin
