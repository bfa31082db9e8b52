#include <gtest/gtest.h>

#include <stdexcept>

#include "pipeline/validation/lagrange/lagrange_cylinder.h"
#include "pipeline/validation/lagrange/lagrange_mesh.h"
#include "pipeline/validation/lagrange/strain_jump.h"

namespace mammotwin::lagrange_comparison_test {
namespace {

// A field that the order holds is the same polynomial whether nodes or Hermite coefficients carry
// it.
TEST(LagrangeElement, HermiteCoefficientsCarryTheSameField) {
  for (int order : {1, 2}) {
    const LagrangeElement element(order);
    const auto field = [order](const Eigen::Vector3d& p) {
      const double s = order == 1 ? p.x() * p.y() : p.x() * p.x() * p.y() * p.z() * p.z();
      return Eigen::Vector3d(p.x() + s, p.y() - 2 * s, p.z() + 3 * s);
    };
    std::vector<HermiteMesh::Node> corners(8, HermiteMesh::Node::Zero());
    for (int c = 0; c < 8; ++c) {  // the unit cube
      corners[c].col(0) = Eigen::Vector3d(c & 1, c >> 1 & 1, c >> 2);
      for (int i = 0; i < 3; ++i) corners[c](i, 1 << i) = 1;
    }
    const LagrangeMesh mesh(HermiteMesh(corners, {{0, 1, 2, 3, 4, 5, 6, 7}}), element);
    ASSERT_EQ(static_cast<int>(mesh.X.size()), element.num_nodes());
    std::vector<Eigen::Vector3d> x;
    for (const auto& X : mesh.X) x.push_back(field(X));
    const HermiteMesh broken = mesh.broken(x);
    for (const Eigen::Vector3d& xi : {Eigen::Vector3d(0.2, 0.7, 0.4), Eigen::Vector3d(0.9, 0.1, 1)})
      EXPECT_LT((broken.position({0, xi}) - field(xi)).norm(), 1e-14) << order;
  }
  EXPECT_THROW(LagrangeElement(3), std::invalid_argument);
}

// Peers on the same cylinder: FEBio's trilinear three-field hexahedra 8.4607 N (1,425 unknowns),
// and the limit 8.515 ± 0.010 N, from which both elements are off by what their meshes are: -0.5 %
// and +0.3 %.
TEST(LagrangeCylinder, ComesNearThePeers) {
  CylinderExperiment x;
  x.elements = even_elements(3);
  const auto trilinear = squeeze_lagrange_cylinder(x, 1);
  ASSERT_TRUE(trilinear.usable) << trilinear.reason;
  EXPECT_NEAR(trilinear.force_N / 8.515, 1, 0.015);
  x.elements = even_elements(2);
  const auto triquadratic = squeeze_lagrange_cylinder(x, 2);
  ASSERT_TRUE(triquadratic.usable) << triquadratic.reason;
  EXPECT_NEAR(triquadratic.force_N / 8.515, 1, 0.004);
  EXPECT_NEAR(triquadratic.half_width_middle_mm, 17.404, 0.02);
  EXPECT_LE(triquadratic.penetration_mm, 0.001);
  // Lagrange's strain jumps across faces; Hermite's does so only at the irregular lines of the
  // disc.
  const auto hermite = squeeze_cylinder(x);
  EXPECT_LT(strain_jump(hermite.before.mesh, hermite.after.mesh),
            0.5 * strain_jump(triquadratic.before.mesh, triquadratic.after.mesh));
}

}  // namespace
}  // namespace mammotwin::lagrange_comparison_test
