#include "segmentation/chest_wall/drawn_wall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// 61 rays from -90 to 90 degrees in each of 50 rows of 2 mm from z = 0 on, round x = 0, y = 100.
PectoralWall even_grid() {
  PectoralWall grid;
  grid.axis_y = 100;
  grid.angles = 61, grid.rows = 50;
  grid.first_angle = -90 * kDegree, grid.angle_step = 3 * kDegree;
  grid.z_step = 2;
  return grid;
}

Eigen::Vector3d at(double degrees, double radius, double z) {
  return {radius * std::sin(degrees * kDegree), 100 - radius * std::cos(degrees * kDegree), z};
}

std::size_t ray(int degrees, int z) {
  return static_cast<std::size_t>(z / 2) * 61 + (degrees + 90) / 3;
}

TEST(DrawnWall, IsInterpolatedBetweenPointsAndBetweenSlices) {
  const auto rays = drawn_radii(even_grid(), {at(30, 90, 10), at(12, 80, 10),  // in any order
                                              at(12, 100, 50), at(30, 100, 50)});
  EXPECT_NEAR(rays[ray(12, 10)].mean, 80, 1e-9);
  EXPECT_NEAR(rays[ray(21, 10)].mean, 85, 1e-9);
  EXPECT_NEAR(rays[ray(21, 30)].mean, 92.5, 1e-9) << "half-way up";
  EXPECT_NEAR(rays[ray(21, 10)].spread, 0.7, 1e-9);
  EXPECT_NEAR(rays[ray(21, 30)].spread, std::hypot(0.7, 2.0), 1e-9);
}

TEST(DrawnWall, NothingIsKnownBeyondWhatWasDrawnOrFarBetween) {
  const auto rays = drawn_radii(
      even_grid(), {at(0, 90, 10), at(18, 90, 10), at(45, 90, 10), at(0, 90, 80), at(18, 90, 80)});
  EXPECT_EQ(rays[ray(-3, 10)].spread, 0);
  EXPECT_EQ(rays[ray(30, 10)].spread, 0) << "27 degrees lie between the points";
  EXPECT_GT(rays[ray(45, 10)].spread, 0) << "a point alone";
  EXPECT_EQ(rays[ray(9, 46)].spread, 0) << "70 mm lie between the slices";
  EXPECT_NEAR(rays[ray(9, 8)].mean, 90, 1e-9) << "the row beside";
  EXPECT_EQ(rays[ray(9, 6)].spread, 0);
  EXPECT_TRUE(drawn_radii(even_grid(), {}).empty());
}

TEST(DrawnWall, GoesBeforeWhatIsUsual) {
  const auto drawn = drawn_radii(even_grid(), {at(0, 90, 10), at(18, 90, 10)});
  const std::vector<UsualRadius> usual(drawn.size(), {110, 7});
  const auto both = with_drawn(usual, drawn);
  EXPECT_NEAR(both[ray(9, 10)].mean, 90, 1e-9);
  EXPECT_EQ(both[ray(9, 14)].mean, 110);
  EXPECT_EQ(with_drawn({}, drawn).size(), drawn.size());
}

TEST(DrawnWall, RefusesAPointWhereNoWallCanBe) {
  for (const Eigen::Vector3d& x : {at(120, 90, 10), at(0, 20, 10), at(0, 400, 10)})
    expect_mentions(message_of([&] {
                      drawn_radii(even_grid(), {at(0, 90, 10), x});
                    }),
                    {"chest wall drawn", "no chest wall can be", "LPS"});
}

TEST(DrawnWall, SlicesAboveAndBelowDoNotCount) {
  const auto alone = drawn_radii(even_grid(), {at(0, 90, 10)});
  const auto both = drawn_radii(even_grid(), {at(0, 90, 10), at(0, 90, 300)});
  for (std::size_t n = 0; n < alone.size(); ++n) EXPECT_EQ(alone[n].mean, both[n].mean);
  expect_mentions(message_of([] { drawn_radii(even_grid(), {at(0, 90, 300)}); }),
                  {"no chest wall can be"});
}

}  // namespace
}  // namespace mammotwin
