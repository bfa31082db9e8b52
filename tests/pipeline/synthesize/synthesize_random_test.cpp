#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/synthesize/counter_random.h"
#include "pipeline/synthesize/lattice_noise.h"

namespace mammotwin {
namespace {

TEST(CounterRandom, NumberDependsOnSeedStreamAndCounterOnly) {
  CounterRandom a(1, 2), b(1, 2, 3);
  a.bits(), a.bits(), a.bits();
  EXPECT_EQ(a.bits(), b.bits());
  EXPECT_NE(CounterRandom(1, 2).bits(), CounterRandom(2, 2).bits());
  EXPECT_NE(CounterRandom(1, 2).bits(), CounterRandom(1, 3).bits());
}

TEST(CounterRandom, NormalHasMeanZeroVarianceOneAndLittleKurtosis) {
  CounterRandom random(5, 0);
  constexpr int count = 200000;
  double m1 = 0, m2 = 0, m4 = 0;
  for (int n = 0; n < count; ++n) {
    const double x = random.normal();
    m1 += x / count, m2 += x * x / count, m4 += x * x * x * x / count;
  }
  // Standard errors 1/sqrt(n), sqrt(2/n), sqrt(96/n): 0.0022, 0.0032, 0.022; four of each.
  EXPECT_NEAR(m1, 0, 0.009);
  EXPECT_NEAR(m2, 1, 0.013);
  EXPECT_NEAR(m4, 2.9, 0.09);  // sum of 12 uniforms: 3 - 1.2 / 12
}

TEST(LatticeNoise, IsZeroOnItsNodesAndContinuous) {
  const LatticeNoise noise(3, 4, 10);
  EXPECT_NEAR(noise({20, -30, 10}), 0, 1e-12);
  const Eigen::Vector3d x(10, 3, 7);  // on a face between two cells
  // Slopes of the noise are below 3 per wavelength.
  EXPECT_NEAR(noise(x - Eigen::Vector3d(1e-6, 0, 0)), noise(x + Eigen::Vector3d(1e-6, 0, 0)), 1e-6);
}

}  // namespace
}  // namespace mammotwin
