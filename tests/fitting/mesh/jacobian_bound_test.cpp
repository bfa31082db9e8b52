#include "fitting/mesh/jacobian_bound.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/fitting/distorted_mesh.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

/// Gauss-Legendre's five points and weights on [0,1].
struct GaussRule {
  std::array<double, 5> at, weight;

  GaussRule() {
    const double root = 2 * std::sqrt(10.0 / 7), inner = std::sqrt(5 - root) / 3,
                 outer = std::sqrt(5 + root) / 3, share = 13 * std::sqrt(70.0);
    at = {(1 - outer) / 2, (1 - inner) / 2, 0.5, (1 + inner) / 2, (1 + outer) / 2};
    weight = {(322 - share) / 1800, (322 + share) / 1800, 64.0 / 225, (322 + share) / 1800,
              (322 - share) / 1800};
  }
};

double sampled_minimum(const HermiteMesh& mesh, int samples) {
  double smallest = 1e300;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int m = 0; m < samples * samples * samples; ++m) {
      const Vector3d at(m % samples, m / samples % samples, m / (samples * samples));
      smallest = std::min(smallest, mesh.jacobian({e, at / (samples - 1)}).determinant());
    }
  return smallest;
}

TEST(JacobianBound, IsOneInABox) {
  const HermiteMesh box = block_mesh(Vector3d::Zero(), Vector3d(2, 4, 8), {2, 2, 2});
  const JacobianBound bound = bound_jacobian(box);
  EXPECT_NEAR(bound.lower, 1, 1e-6);  // less the slack of 1e-7 for rounding
  EXPECT_NEAR(bound.sampled, 1, 1e-12);
  EXPECT_TRUE(proved_valid(box));
  for (double scaled : scaled_jacobians(box)) EXPECT_NEAR(scaled, 1, 1e-12);
}

/// Mean of |∫ det dξ| over the elements: 5 Gauss points are exact for its degree of 8.
double mean_determinant(const HermiteMesh& mesh) {
  const GaussRule rule;
  double sum = 0;
  for (int e = 0; e < mesh.num_elements(); ++e) {
    double volume = 0;
    for (int m = 0; m < 125; ++m) {
      const int a = m % 5, b = m / 5 % 5, c = m / 25;
      volume += rule.weight[a] * rule.weight[b] * rule.weight[c] *
                mesh.jacobian({e, {rule.at[a], rule.at[b], rule.at[c]}}).determinant();
    }
    sum += std::abs(volume);
  }
  return sum / mesh.num_elements();
}

TEST(JacobianBound, LiesBelowEverySampleAndNear) {
  for (double amount : {0.5, 1.0, 2.0, 3.0}) {
    const HermiteMesh mesh = distorted_mesh({2, 2, 2}, amount);
    const JacobianBound bound = bound_jacobian(mesh);
    const double smallest = sampled_minimum(mesh, 17) / mean_determinant(mesh);
    EXPECT_LE(bound.lower, smallest);  // rounding lowers it by 1e-7 already
    EXPECT_LE(bound.sampled - 0.02, bound.lower);
    EXPECT_EQ(proved_valid(mesh), bound.proved());
  }
}

TEST(JacobianBound, SeesAFoldBetweenSamples) {
  // x = ξ + a (cubic in ξ₁ with slope 1 at both ends): x' dips to 1 − a at ξ₁ = 1/2 only.
  HermiteMesh box = block_mesh(Vector3d::Zero(), Vector3d::Ones(), {1, 1, 1});
  const auto with_slopes = [&](double slope) {
    std::vector<HermiteMesh::Node> nodes = box.nodes();
    for (auto& node : nodes) node(0, 1) = slope;
    return HermiteMesh(nodes, box.elements());
  };
  // With end slopes s the middle slope is 3/2 − s/2.
  EXPECT_TRUE(proved_valid(with_slopes(2.99)));
  EXPECT_FALSE(proved_valid(with_slopes(3.01)));
  EXPECT_FALSE(bound_elements(with_slopes(3.01))[0].proved());
  EXPECT_LT(bound_jacobian(with_slopes(3.01)).sampled, 0);
}

}  // namespace
}  // namespace mammotwin
