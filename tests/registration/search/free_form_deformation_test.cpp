#include "registration/search/free_form_deformation.h"

#include <gtest/gtest.h>

#include <random>

#include "fitting/mesh/block_mesh.h"

namespace mammotwin {
namespace {

/// Displacements of a few millimetres.
FreeFormDeformation drawn() {
  FreeFormDeformation drawn({0, -60}, {80, 70});
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 3);
  Eigen::Matrix2Xd controls = drawn.controls();
  for (double& number : controls.reshaped()) number = normal(random);
  drawn.set_controls(controls);
  return drawn;
}

TEST(FreeFormDeformation, KnowsItsDerivatives) {
  const FreeFormDeformation deformation = drawn();
  constexpr double h = 1e-4;
  for (const Eigen::Vector2d& x :
       {Eigen::Vector2d(7, -51), Eigen::Vector2d(33, 3), Eigen::Vector2d(79, 64)})
    for (int i = 0; i < 3; ++i)
      for (int j = 0; i + j < 3; ++j) {
        const auto difference = [&](const Eigen::Vector2d& step) -> Eigen::Vector2d {
          return (deformation.at(x + step, i, j) - deformation.at(x - step, i, j)) / (2 * h);
        };
        const Eigen::Vector2d by_depth = difference({h, 0}), by_lateral = difference({0, h});
        EXPECT_LT((deformation.at(x, i + 1, j) - by_depth).norm(), 1e-7) << i << j;
        EXPECT_LT((deformation.at(x, i, j + 1) - by_lateral).norm(), 1e-7) << i << j;
        EXPECT_GT(by_depth.norm(), 1e-6);
      }
}

TEST(FreeFormDeformation, StaysThatOfItsBorderBeyondIt) {
  const FreeFormDeformation deformation = drawn();
  EXPECT_LT((deformation.at({-20, 10}) - deformation.at({0, 10})).norm(), 1e-12);
  EXPECT_EQ(deformation.at({-20, 10}, 1, 0).norm(), 0);
  EXPECT_GT(deformation.at({-20, 10}, 0, 1).norm(), 0);
  EXPECT_EQ(FreeFormDeformation().at({1, 2}).norm(), 0);
}

// All eight parameters of a node against differences of x + at(x) along the element's coordinates.
TEST(FreeFormDeformation, MovesNodesWithTheirDerivatives) {
  const FreeFormDeformation deformation = drawn();
  HermiteMesh mesh = block_mesh({5, -50, 0}, {75, 60, 40}, {2, 2, 2});
  std::vector<HermiteMesh::Node> nodes = mesh.nodes();
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, 4);
  for (HermiteMesh::Node& node : nodes)
    for (double& number : node.reshaped()) number += normal(random);
  mesh = HermiteMesh(nodes, mesh.elements());
  const auto moved = [&](const Eigen::Vector3d& xi) {
    Eigen::Vector3d x = mesh.position({0, xi});
    x.head<2>() += deformation.at(x.head<2>());
    return x;
  };
  constexpr double h = 1e-3;
  const HermiteMesh::Node node = deformation.moved(mesh.node(mesh.corners(0)[0]));
  for (int parameter = 0; parameter < 8; ++parameter) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // central differences along its bits
    for (int signs = 0; signs < 8; ++signs) {
      if (signs & ~parameter) continue;
      Eigen::Vector3d xi = Eigen::Vector3d::Zero();
      double sign = 1;
      for (int i = 0; i < 3; ++i)
        if (parameter >> i & 1) {
          xi[i] = signs >> i & 1 ? h : -h;
          sign *= xi[i] / h / (2 * h);
        }
      sum += sign * moved(xi);
    }
    EXPECT_LT((node.col(parameter) - sum).norm(), 0.02) << parameter;
  }
}

}  // namespace
}  // namespace mammotwin
