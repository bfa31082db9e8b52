#include "fitting/mesh/jacobian_bound.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/fitting/distorted_mesh.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

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

TEST(JacobianBound, LiesBelowEverySampleAndNear) {
  for (double amount : {0.5, 1.0, 2.0, 3.0}) {
    const HermiteMesh mesh = distorted_mesh({2, 2, 2}, amount);
    const JacobianBound bound = bound_jacobian(mesh);
    // 10 mm bricks: the mean determinant is 1000 mm³ up to what the disturbance adds.
    const double smallest = sampled_minimum(mesh, 17) / 1000;
    EXPECT_LE(bound.lower, smallest * (smallest > 0 ? 1.15 : 0.85) + 1e-6);
    EXPECT_GT(bound.lower, bound.sampled - 0.02);
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
