#include "solver/gravity/pose_equilibria.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "solver/material/exponential.h"
#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

using Nodes = std::vector<HermiteMesh::Node>;

const Eigen::Vector3d kSupine(0, 9810, 0);  // [mm/s²]

/// A dome that hangs, of tissue times exp(`stiffer`), on springs times exp(`springs`).
BreastProblem dome(double stiffer, double springs, double b = 1) {
  BreastProblem problem = dome_problem(60);
  problem.mesh = dome_breast({3, 3, 1});
  problem.gravity = {0, -9810, 0};
  problem.laws.laws.fill(std::make_shared<Exponential>(0.3 * std::exp(stiffer), b));
  problem.boundary.chest_wall_spring *= std::exp(springs);
  return problem;
}

Nodes difference(const Nodes& a, const Nodes& b) {
  Nodes d = a;
  for (std::size_t i = 0; i < d.size(); ++i) d[i] -= b[i];
  return d;
}

double largest(const Nodes& nodes) {
  double size = 0;
  for (const auto& node : nodes) size = std::max(size, node.col(0).norm());
  return size;
}

/// Both changes against those of two breasts solved anew on either side, which differ from a
/// derivative by terms of the second order.
void expect_derivative(const std::function<BreastProblem(double)>& at) {
  constexpr double h = 1e-3;
  const PoseEquilibria here(at(0), kSupine), below(at(-h), kSupine), above(at(h), kSupine);
  ASSERT_TRUE(here.usable() && below.usable() && above.usable())
      << here.reason() << below.reason() << above.reason();
  EXPECT_EQ(here.gravity_share(), 1);
  const PoseEquilibria::Step step = here.step(at(-h), at(h));
  const Nodes unloaded = difference(above.unloaded(), below.unloaded()),
              posed = difference(above.posed(), below.posed());
  EXPECT_GT(largest(unloaded), 1e-4);
  EXPECT_GT(largest(posed), 1e-4);
  EXPECT_LT(largest(difference(step.unloaded, unloaded)), 1e-4 * largest(unloaded));
  EXPECT_LT(largest(difference(step.posed, posed)), 1e-4 * largest(posed));
}

TEST(PoseEquilibria, FollowsTheTissuesStiffness) {
  expect_derivative([](double q) { return dome(q, 0); });
}

TEST(PoseEquilibria, FollowsTheSpringsOfTheWall) {
  expect_derivative([](double q) { return dome(0, q); });
}

TEST(PoseEquilibria, FollowsTheLaw) {
  expect_derivative([](double q) { return dome(0, 0, std::exp(4 * q)); });
}

// Twenty times too soft, no part of the weight leaves a breast that would hang so again.
TEST(PoseEquilibria, SaysWhyThereIsNone) {
  const PoseEquilibria none(dome(-3, -3), kSupine);
  EXPECT_LT(none.gravity_share(), 1);
}

}  // namespace
}  // namespace mammotwin
