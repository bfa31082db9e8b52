#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/evaluate/cases/population.h"

namespace mammotwin {
namespace {

std::vector<SyntheticBreast> population() {
  std::vector<SyntheticBreast> all;
  for (int n = 0; n < 200; ++n) all.push_back(draw_breast(n));
  return all;
}

TEST(Population, EveryBreastIsOneThatTheSynthesizerTakes) {
  for (const SyntheticBreast& b : population())
    for (int attempt = 0; attempt < 3; ++attempt)
      EXPECT_NO_THROW(check(draw_breast(b.number, attempt).patient)) << b.name;
}

TEST(Population, KeepsToTheRangesOfTheIssue) {
  for (const SyntheticBreast& b : population()) {
    EXPECT_TRUE(b.stiffness_ratio >= 1 && b.stiffness_ratio <= 10) << b.name;
    for (const double fraction : {b.cc_fraction, b.mlo_fraction})
      EXPECT_TRUE(fraction >= 0.25 && fraction <= 0.76) << b.name;
    EXPECT_TRUE(b.patient.views.mlo_angle_deg >= 30 && b.patient.views.mlo_angle_deg <= 60);
  }
}

TEST(Population, AtLeastAQuarterOfTheCompressionsAreHard) {
  int hard = 0;
  for (const SyntheticBreast& b : population())
    for (const double fraction : {b.cc_fraction, b.mlo_fraction})
      hard += fraction > 0.6 && b.stiffness_ratio >= 5;
  EXPECT_GE(hard, 100);  // of 400
  EXPECT_LT(hard, 160);  // and is not all hard: 100 by rule, some 20 of the 300 by chance
}

TEST(Population, VolumesAndRatiosAreLogUniform) {
  int small = 0, soft = 0, easy = 0;
  for (const SyntheticBreast& b : population()) {
    small += b.patient.anatomy.volume_ml < std::sqrt(150.0 * 1500);
    if (b.hard) continue;
    ++easy;
    soft += b.stiffness_ratio < std::sqrt(10.0);
  }
  // Half of 200 and of 150, with four binomial standard deviations: sqrt(50) and sqrt(37.5).
  EXPECT_EQ(easy, 150);
  EXPECT_NEAR(small, 100, 28);
  EXPECT_NEAR(soft, 75, 25);
}

TEST(Population, HoldsBothSidesAndOneToThreeLesions) {
  std::set<int> lesions;
  std::set<Side> sides;
  for (const SyntheticBreast& b : population())
    lesions.insert(b.patient.anatomy.lesions), sides.insert(b.patient.anatomy.side);
  EXPECT_EQ(lesions, (std::set<int>{1, 2, 3}));
  EXPECT_EQ(sides.size(), 2u);
}

TEST(Population, AnotherAttemptKeepsWhatTheLawPromises) {
  const SyntheticBreast first = draw_breast(7, 0), second = draw_breast(7, 1);
  EXPECT_NE(first.patient.anatomy.seed, second.patient.anatomy.seed);
  EXPECT_NE(first.patient.anatomy.chest_half_width_mm, second.patient.anatomy.chest_half_width_mm);
  EXPECT_EQ(first.patient.anatomy.volume_ml, second.patient.anatomy.volume_ml);
  EXPECT_EQ(first.patient.anatomy.density, second.patient.anatomy.density);
  EXPECT_EQ(first.stiffness_ratio, second.stiffness_ratio);
  EXPECT_EQ(first.cc_fraction, second.cc_fraction);
}

}  // namespace
}  // namespace mammotwin
