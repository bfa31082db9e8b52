#include "fitting/solve/fit_model.h"

#include <gtest/gtest.h>

#include <random>

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
        {p, n.normalized(), mesh.position(p) + Eigen::Vector3d(0.3, -0.8, 0.5), 0.02, 0.1});
  }
  return samples;
}

/// A central difference of `f` by the parameter `x`.
template <class Function>
auto difference(double& x, double h, const Function& f) -> decltype(f()) {
  const double before = x;
  x = before + h;
  const auto up = f();
  x = before - h;
  const auto down = f();
  x = before;
  return (up - down) / (2 * h);
}

TEST(FitModel, GradientMatchesDifferencesInEveryParameter) {
  // Nothing is folded here, so that the energy's epsilon does not depend on the nodes.
  const HermiteMesh mesh = distorted_mesh(slab.elements, 1.5);
  const std::vector<PlaneSample> samples = some_samples(mesh);
  FitModel model(graded, mesh);
  model.weigh(1, 1e-6);
  model.shape_energy().emphasise(3);
  model.tether(0.03, distorted_mesh(slab.elements, 0.5).nodes());
  std::vector<HermiteMesh::Node> nodes = mesh.nodes();
  for (bool steep : {false, true}) {
    model.shape_energy().steepen(steep);
    for (int e = 2; e < 4; ++e) {
      model.move_to(nodes, samples);
      const ElementVector gradient = model.quadratic(e).gradient;
      for (int p = 0; p < element_size; ++p) {
        double& x = nodes[mesh.corners(e)[p / 24]].data()[p % 24];
        const double expected = difference(x, 1e-5, [&] {
          model.move_to(nodes, samples);
          return model.cost(e);
        });
        // Costs of order 1 lose 1e-16 / h = 1e-11 to rounding.
        EXPECT_NEAR(gradient[p], expected, 1e-8) << "element " << e << ", parameter " << p;
      }
    }
  }
}

TEST(FitModel, OfSamplesSmoothingAndTetherTheHessianIsExact) {
  const HermiteMesh mesh = distorted_mesh(slab.elements, 1.5);
  const std::vector<PlaneSample> samples = some_samples(mesh);
  FitModel model(slab, mesh);
  model.weigh(0, 1e-6);
  model.tether(0.03, distorted_mesh(slab.elements, 0.5).nodes());
  std::vector<HermiteMesh::Node> nodes = mesh.nodes();
  model.move_to(nodes, samples);
  const ElementMatrix hessian = model.quadratic(1).hessian;
  for (int p = 0; p < element_size; ++p) {
    double& x = nodes[mesh.corners(1)[p / 24]].data()[p % 24];
    const ElementVector expected = difference(x, 1.0, [&]() -> ElementVector {
      model.move_to(nodes, samples);
      return model.quadratic(1).gradient;
    });
    // Both are linear in x: only rounding is left.
    EXPECT_LT((hessian.col(p) - expected).norm(), 1e-10 * hessian.norm()) << "parameter " << p;
  }
}

/// ∂x/∂ξ over the lengths of the box at ξ, by all parameters of one element.
Eigen::MatrixXd scaled_gradient(const Eigen::Vector3d& xi, double length) {
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(9, element_size);
  for (int i = 0; i < 3; ++i) {
    std::array<int, 3> order = {0, 0, 0};
    order[i] = 1;
    const BasisRow row = basis_row(xi, order) / length;
    for (int p = 0; p < 64; ++p)
      for (int c = 0; c < 3; ++c) g(c + 3 * i, 3 * p + c) = row[p];
  }
  return g;
}

// One cube of 10 mm, whose wanted lengths are its own: F is ∂x/∂ξ over 10 mm.
TEST(FitModel, OfTheEnergyTheHessianIsTheSumOfItsPoints) {
  const Slab one{{1, 1, 1}};
  const HermiteMesh cube = distorted_mesh(one.elements, 0), bent = distorted_mesh(one.elements, 2);
  const double s = std::sqrt(3.0 / 7) / 2;
  const std::vector<double> lobatto = {0, 0.5 - s, 0.5, 0.5 + s, 1};
  const std::vector<double> even = {0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1};
  for (const auto& [points, emphasis] : {std::pair{lobatto, 0}, {even, 1}, {even, 2}}) {
    FitModel model(one, cube);
    model.weigh(0.7, 0);
    for (int i = 0; i < emphasis; ++i) model.shape_energy().emphasise(0);
    model.shape_energy().take_gauss_newton(emphasis == 1);
    model.move_to(bent.nodes(), {});
    const double weight = 0.7 * std::pow(4, emphasis) / std::pow(points.size(), 3);
    ElementMatrix expected = ElementMatrix::Zero(element_size, element_size);
    for (double a : points)
      for (double b : points)
        for (double c : points) {
          const Eigen::MatrixXd g = scaled_gradient({a, b, c}, 10);
          const Eigen::Matrix3d F = bent.jacobian({0, {a, b, c}}) / 10;
          ASSERT_GT(F.determinant(), 0);
          const FoldoverEnergy e{1e-3};
          expected += weight * g.transpose() *
                      (emphasis == 1 ? e.gauss_newton(F) : e.convex_hessian(F)) * g;
        }
    EXPECT_LT((model.quadratic(0).hessian - expected).norm(), 1e-12 * expected.norm());
  }
}

double total(const FitModel& model) {
  double sum = 0;
  for (int e = 0; e < model.num_elements(); ++e) sum += model.cost(e);
  return sum;
}

TEST(FitModel, SmoothingIsZeroForABrickAndGrowsWithBends) {
  const HermiteMesh box = distorted_mesh(slab.elements, 0);
  FitModel model(slab, box);
  model.weigh(1, 1);
  model.move_to(box.nodes(), {});
  // What is left is the energy of bricks that are not cubes' scale: e = 1.05 each.
  EXPECT_NEAR(total(model), 1.05, 1e-6);  // ε = 1e-3 enters by ε²/4
  const HermiteMesh bent = distorted_mesh(slab.elements, 1);
  model.move_to(bent.nodes(), {});
  EXPECT_GT(total(model), 100);
}

}  // namespace
}  // namespace mammotwin
