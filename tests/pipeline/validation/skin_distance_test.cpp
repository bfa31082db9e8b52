#include "pipeline/validation/skin_distance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

/// A ball round the origin, of triangles about a fortieth of its radius.
TriangleSurface ball(double radius) {
  constexpr int rings = 80, around = 160;
  constexpr double pi = 3.14159265358979;
  TriangleSurface s;
  for (int j = 0; j <= rings; ++j)
    for (int i = 0; i < around; ++i) {
      const double polar = pi * j / rings, turn = 2 * pi * i / around;
      s.vertices.push_back(radius * Eigen::Vector3d(std::sin(polar) * std::cos(turn),
                                                    std::sin(polar) * std::sin(turn),
                                                    std::cos(polar)));
    }
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = around * j + i, b = around * j + (i + 1) % around;
      s.triangles.push_back({a, a + around, b});
      s.triangles.push_back({b, a + around, b + around});
    }
  return s;
}

// Triangles of pi/80 stand off their sphere by 1 - cos(pi/160) = 0.0002 of the radius.
constexpr double sagitta = 0.0002;

TEST(SkinDistance, OfConcentricBallsIsTheDifferenceOfTheirRadii) {
  EXPECT_NEAR(rms_distance(ball(50), ball(52)), 2, 52 * 2 * sagitta);
  EXPECT_NEAR(rms_distance({{51, 0, 0}, {0, -53, 0}}, ball(50)), std::sqrt((1 + 9) / 2.0),
              50 * 2 * sagitta);
}

TEST(SideOutline, OfABallIsACircle) {
  for (const double r : side_outline(ball(50), {0, 0})) EXPECT_NEAR(r, 50, 50 * 2 * sagitta);
}

TEST(SideOutline, LooksForwardAndUpwardsInOrder) {
  // From 20 mm above the middle the ball reaches farther downwards; rays run from below to above.
  const std::vector<double> outline = side_outline(ball(50), {0, 20});
  ASSERT_EQ(outline.size(), 121u);
  // At 60 degrees below: |(-r/2, 20 - r sin 60)| = 50 gives r = 10 sqrt 3 + sqrt(300 + 2100).
  EXPECT_NEAR(outline.front(), std::sqrt(300.0) + std::sqrt(2400.0), 0.05);
  EXPECT_NEAR(outline[60], std::sqrt(2100.0), 0.05);
  EXPECT_NEAR(outline.back(), -std::sqrt(300.0) + std::sqrt(2400.0), 0.05);
}

}  // namespace
}  // namespace mammotwin
