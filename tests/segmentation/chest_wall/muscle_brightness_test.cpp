#include "segmentation/chest_wall/muscle_brightness.h"

#include <gtest/gtest.h>

#include <numbers>

namespace mammotwin {
namespace {

/// Fat of 1, muscle of some brightness 13 mm thick, lung; the wall 5 mm deeper than usual.
double learnt(double muscle) {
  PectoralWall grid;
  grid.angles = 121, grid.rows = 40;
  grid.first_angle = -std::numbers::pi / 2, grid.angle_step = std::numbers::pi / 120;
  grid.z_step = 2;
  constexpr std::size_t count = 121U * 40;
  const std::vector<UsualRadius> usual(count, {110, 8});
  PolarRays rays{40, 121, {}, std::vector<int>(count, 170)};
  for (std::size_t n = 0; n < count; ++n)
    for (int d = 0; d < PolarRays::depths; ++d) {
      const double r = PolarRays::least_radius_mm + d;
      rays.intensity.push_back(static_cast<float>(r > 105 ? 1 : r > 92 ? muscle : 0.25));
    }
  return learnt_muscle(rays, grid, usual, -10, 100);
}

TEST(MuscleBrightness, IsLearntFromTheImage) {
  for (const double muscle : {0.6, 1.6, 2.8})
    EXPECT_NEAR(learnt(muscle), muscle, 0.03 * muscle) << "half a bin";
}

}  // namespace
}  // namespace mammotwin
