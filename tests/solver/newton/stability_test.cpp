#include "solver/newton/stability.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "solver/material/neo_hookean.h"
#include "solver/newton/newton.h"
#include "tests/solver/test_meshes.h"

namespace mammotwin {
namespace {

Eigen::MatrixXd dense(const SparsePattern& pattern, const std::vector<double>& values) {
  Eigen::MatrixXd matrix(pattern.num_columns(), pattern.num_columns());
  for (int c = 0; c < pattern.num_columns(); ++c)
    matrix.col(c) = multiply(pattern, values, Eigen::VectorXd::Unit(pattern.num_columns(), c));
  return matrix;
}

/// A column of 2 x 2 x 20 mm, clamped at its foot; its top only moves along the axis.
struct Column {
  HermiteMesh mesh = box_mesh({2, 2, 20}, {1, 1, 3});
  Model model{mesh, uniform(std::make_shared<NeoHookean>(3)), {PressureSpace::trilinear, 1e4, 0}};
  DofMap dofs{mesh};
  Column() {
    for (double height : {0.0, 20.0})
      for (int i = 0; i < 3; ++i)
        for (const auto& [e, face] : faces_at(mesh, 2, height))
          for (int dof : face_dofs(mesh, e, face, i)) dofs.prescribe(dof);
    dofs.number(mesh);
  }
  std::vector<HermiteMesh::Node> shortening(double way) const {
    std::vector<HermiteMesh::Node> moves(mesh.num_nodes(), HermiteMesh::Node::Zero());
    for (int i = 0; i < mesh.num_nodes(); ++i)
      if (mesh.node(i)(2, 0) > 20 - 1e-9) moves[i](2, 0) = -way;
    return moves;
  }
};

// Against Eigen's dense solver for the generalised problem; Lanczos stops within 1 %.
TEST(SmallestStiffness, IsTheDenseSolversSmallestEigenvalue) {
  Column column;
  Newton newton(column.model, column.dofs);
  Assembler assembler(column.model, column.dofs);
  State state = column.model.rest();
  const auto metric = assembler.metric();
  const auto exact = [&] {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> all(
        dense(assembler.pattern(), assembler.matrix()), dense(assembler.pattern(), metric),
        Eigen::EigenvaluesOnly);
    return all.eigenvalues()[0];
  };
  Cholesky factor(assembler.pattern(), column.dofs.node_of_equation());
  assembler.linearise(state, {});
  ASSERT_TRUE(factor.factor(assembler.matrix()));
  const double at_rest = smallest_stiffness(factor, assembler.pattern(), metric);
  EXPECT_NEAR(at_rest / exact(), 1, 0.01);
  ASSERT_TRUE(newton.solve(state, {}, column.shortening(0.2)).usable());
  assembler.linearise(state, {});
  ASSERT_TRUE(factor.factor(assembler.matrix()));
  const double pressed = smallest_stiffness(factor, assembler.pattern(), metric);
  EXPECT_NEAR(pressed / exact(), 1, 0.01);
}

// Euler: a clamped column buckles at a strain of (2 pi)²/12 (side/length)², 3.3 % here. Pressed by
// 8 % without any cause to go sideways, it must not be left standing straight.
TEST(Newton, LeavesAnUnstableEquilibrium) {
  Column column;
  Newton newton(column.model, column.dofs);
  State state = column.model.rest();
  const NewtonReport report = newton.solve(state, {}, column.shortening(1.6));
  ASSERT_TRUE(report.usable()) << report.reason;
  EXPECT_TRUE(newton.is_stable(state));
  double sideways = 0;
  for (int i = 0; i < column.mesh.num_nodes(); ++i)
    sideways = std::max(sideways, (state.x[i] - column.mesh.node(i)).col(0).head<2>().norm());
  EXPECT_GT(sideways, 1);
}

// A column beyond Euler's load that is pushed a little aside: full steps of the energy's convex
// parts alone took 13 iterations.
TEST(Newton, DoublesStepsAlongNegativeCurvature) {
  Column column;
  Newton newton(column.model, column.dofs);
  State state = column.model.rest();
  NewtonOptions straight;
  straight.keep_unstable = true;
  ASSERT_TRUE(newton.solve(state, straight, column.shortening(1.6)).usable());
  for (int i = 0; i < column.mesh.num_nodes(); ++i)
    if (const double z = column.mesh.node(i)(2, 0); z > 1 && z < 19) state.x[i](0, 0) += 0.02;
  const NewtonReport report = newton.solve(state, {});
  ASSERT_TRUE(report.usable()) << report.reason;
  EXPECT_TRUE(newton.is_stable(state));
  EXPECT_LT(report.iterations, 13);
}

TEST(Newton, SaysThatAStraightColumnBeyondEulersLoadIsUnstable) {
  Column column;
  Newton newton(column.model, column.dofs);
  State straight = column.model.rest();
  for (int i = 0; i < column.mesh.num_nodes(); ++i) straight.x[i].row(2) *= 1 - 0.08;
  EXPECT_FALSE(newton.is_stable(straight));
  for (int i = 0; i < column.mesh.num_nodes(); ++i) straight.x[i].row(2) *= (1 - 0.02) / (1 - 0.08);
  EXPECT_TRUE(newton.is_stable(straight));
}

}  // namespace
}  // namespace mammotwin
