#include "fitting/solve/fit_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "fitting/mesh/jacobian_bound.h"
#include "fitting/solve/newton_step.h"
#include "tests/fitting/distorted_mesh.h"

namespace mammotwin {
namespace {

const Slab slab{{2, 2, 1}};
const Slab graded{{2, 2, 1}, {Grading(0.5, 1, 0.12, 2), Grading(0.4, 1, 0.12, 2)}};

std::vector<PlaneSample> some_samples(const HermiteMesh& mesh) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<PlaneSample> samples;
  for (int i = 0; i < 60; ++i) {
    const MeshPoint p{i % mesh.num_elements(), {uniform(random), uniform(random), double(i % 2)}};
    const Eigen::Vector3d n(uniform(random) - 0.5, 1, uniform(random) - 0.5);
    samples.push_back(
        {p, n.normalized(), mesh.position(p) + Eigen::Vector3d(0.3, -0.8, 0.5), 0.02});
  }
  return samples;
}

double total(const FitModel& model, const std::vector<HermiteMesh::Node>& nodes) {
  double sum = 0;
  for (std::size_t e = 0; e < model.elements().size(); ++e)
    sum += model.cost(nodes, static_cast<int>(e));
  return sum;
}

TEST(FitModel, GradientMatchesDifferences) {
  const HermiteMesh mesh = distorted_mesh(slab.elements, 1.5);
  FitModel model(graded, mesh, 1, 1e-6, {0, 0, 0, 1});
  model.update(mesh.nodes(), some_samples(mesh));
  std::vector<HermiteMesh::Node> nodes = mesh.nodes();
  for (int e : {0, 3}) {
    const FitModel::Quadratic q = model.quadratic(nodes, e);
    EXPECT_NEAR(q.cost, model.cost(nodes, e), 1e-14);
    for (int p = 0; p < FitModel::element_size; p += 7) {
      double& x = nodes[mesh.corners(e)[p / 24]].data()[p % 24];
      const double h = 1e-5, before = x;
      x = before + h;
      const double up = model.cost(nodes, e);
      x = before - h;
      const double down = model.cost(nodes, e);
      x = before;
      // Costs of order 1 lose 1e-16 / h = 1e-11 to rounding.
      EXPECT_NEAR(q.gradient[p], (up - down) / (2 * h), 1e-8) << "parameter " << p;
    }
  }
}

TEST(FitModel, HessianIsTheGradientsDerivativeWhereTheEnergyIsConvex) {
  const HermiteMesh mesh = distorted_mesh(slab.elements, 0.1);  // near bricks: nothing is cut off
  FitModel model(slab, mesh, 1, 1e-6, {0, 0, 0, 1});
  model.update(mesh.nodes(), some_samples(mesh));
  std::vector<HermiteMesh::Node> nodes = mesh.nodes();
  const FitModel::Quadratic q = model.quadratic(nodes, 1);
  for (int p = 0; p < FitModel::element_size; p += 11) {
    double& x = nodes[mesh.corners(1)[p / 24]].data()[p % 24];
    const double h = 1e-4, before = x;
    x = before + h;
    const auto up = model.quadratic(nodes, 1).gradient;
    x = before - h;
    const auto down = model.quadratic(nodes, 1).gradient;
    x = before;
    const FitModel::ElementVector difference = (up - down) / (2 * h);
    EXPECT_LT((q.hessian.col(p) - difference).norm(), 0.02 * q.hessian.col(p).norm());
  }
}

TEST(FitModel, SmoothingIsZeroForABrickAndGrowsWithBends) {
  const HermiteMesh box = distorted_mesh(slab.elements, 0);
  FitModel model(slab, box, 1, 1, {0, 0, 0, 0});
  model.update(box.nodes(), {});
  // What is left is the energy of bricks that are not cubes' scale: e = 1.05 each.
  EXPECT_NEAR(total(model, box.nodes()), 1.05, 1e-6);  // ε = 1e-3 enters by ε²/4
  const HermiteMesh bent = distorted_mesh(slab.elements, 1);
  EXPECT_GT(total(model, bent.nodes()), 100);
}

/// Bricks that lie as a breast's slab does: ξ₂ along z, ξ₃ towards −y.
HermiteMesh lying_box() {
  const HermiteMesh box = distorted_mesh(slab.elements, 0);
  Eigen::Matrix3d turn;
  turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  std::vector<HermiteMesh::Node> nodes;
  for (const auto& node : box.nodes()) nodes.push_back(turn * node);
  return HermiteMesh(nodes, box.elements());
}

TEST(NewtonStep, PullsASheetToItsTargetsAndKeepsWhatIsHeld) {
  const HermiteMesh box = lying_box();
  const HeldParameters held = held_parameters(slab);
  NewtonStep newton(box.elements(), held);
  std::vector<HermiteMesh::Node> nodes = box.nodes();
  std::vector<PlaneSample> samples;
  for (int e = 0; e < 4; ++e)
    for (int m = 0; m < 16; ++m) {
      const MeshPoint p{e, {m % 4 / 3.0, m / 4 / 3.0, 1}};
      samples.push_back(
          {p, Eigen::Vector3d::UnitY(), box.position(p) - Eigen::Vector3d(0, 2, 0), 1.0});
    }
  FitModel model(slab, box, 1e-3, 1e-8, {0, 0, 0, 0});
  for (int step = 0; step < 10; ++step) {
    model.update(nodes, samples);
    newton.step(model, nodes, proved_valid);
  }
  const HermiteMesh moved(nodes, box.elements());
  for (const auto& s : samples) EXPECT_NEAR(moved.position(s.point).y(), s.target.y(), 0.01);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (int p = 0; p < 24; ++p) {
      if (!held[n][p]) continue;
      EXPECT_EQ(nodes[n].data()[p], box.node(n).data()[p]);
    }
}

}  // namespace
}  // namespace mammotwin
