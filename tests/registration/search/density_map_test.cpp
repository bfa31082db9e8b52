#include "registration/search/density_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/registration/box_view.h"

namespace mammotwin {
namespace {

/// Of a breast 90 mm deep whose image's edge is as long as a detector is.
DensityGrid grid_of_half_a_disc() {
  std::vector<Eigen::Vector2d> outline;
  for (int deg = -90; deg <= 90; deg += 2)
    outline.push_back(90 * Eigen::Vector2d(std::cos(deg * M_PI / 180), std::sin(deg * M_PI / 180)));
  return density_grid(outline);
}

std::vector<double> waves(const DensityGrid& grid) {
  std::vector<double> values(grid.inside.size());
  for (std::size_t n = 0; n < values.size(); ++n) {
    const Eigen::Vector2d x = grid.middle(static_cast<int>(n)) / 9;
    values[n] = std::sin(x.x()) + std::cos(1.3 * x.y());
  }
  return values;
}

TEST(DensityMap, WhatLiesBehindThePlatesEdgeIsNoPartOfThePattern) {
  const DensityGrid grid = grid_of_half_a_disc();
  const PlatesEdge edge{-25, {25, -10}};
  const std::vector<double> shares = shares_before(edge, grid), values = waves(grid);
  std::vector<double> muscle = values;
  double compared = 0;
  for (const int cell : grid.cells) {
    if (edge.before_mm(grid.middle(cell)) < 0) muscle[cell] = 20;
    compared += shares[cell];
  }
  ASSERT_GT(compared, 0.3 * grid.cells.size());
  ASSERT_LT(compared, 0.8 * grid.cells.size());
  const Eigen::VectorXd alone = pattern(grid, values, shares),
                        beside = pattern(grid, muscle, shares);
  double squares = 0;
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    const double share = shares[grid.cells[n]];
    EXPECT_NEAR(share * alone[n], share * beside[n], 1e-12);
    squares += share * alone[n] * alone[n];
  }
  EXPECT_NEAR(squares / compared, 1, 1e-12);
}

TEST(DensityMap, NothingInViewHasNoPattern) {
  const DensityGrid grid = grid_of_half_a_disc();
  const std::vector<double> none = shares_before({0, {200, 0}}, grid);
  EXPECT_EQ(pattern(grid, waves(grid), none).norm(), 0);
}

// Where a state lays a point of the view it lies as far before the edge as in the view.
TEST(PlatesEdge, GoesWithTheBreastThatIsLaid) {
  const BoxView box;
  ViewState z = ViewState::Zero();
  z[kTurn] = -1.4, z[kShiftDepth] = 2, z[kShiftLateral] = -0.7;
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(0, 30, 0), {12, -50, 5}, {-7, 4, 20}})
    EXPECT_NEAR(box.view.plates_edge(z).before_mm(box.view.placed(x, z).head<2>()), x.x(), 1e-12);
}

}  // namespace
}  // namespace mammotwin
