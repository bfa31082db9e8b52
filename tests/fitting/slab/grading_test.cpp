#include "fitting/slab/grading.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

TEST(Grading, MapsTheEndsToThemselvesAndGrows) {
  for (double centre : {0.05, 0.37, 0.5, 0.9}) {
    const Grading grading(centre, 1, 0.12, 7);
    EXPECT_NEAR(grading(0), 0, 1e-15);
    EXPECT_NEAR(grading(1), 1, 1e-15);
    for (double t = 0; t < 1; t += 0.01) EXPECT_LT(grading(t), grading(t + 0.01));
  }
}

TEST(Grading, BringsItsCentreOnALineBetweenColumns) {
  for (double centre : {0.35, 0.41, 0.5, 0.56}) {
    const double w = 7 * Grading(centre, 1, 0.12, 7)(centre);
    EXPECT_NEAR(w, std::round(w), 1e-12) << centre;
  }
}

TEST(Grading, LeavesACentreBetweenLinesThatWouldTakeASteepSlope) {
  // Near the end a line is as far as half a column: the slope c (c - 1) / 2 is worth little there.
  const Grading grading(0.07, 1, 0.12, 4);
  EXPECT_GT(std::abs(4 * grading(0.07) - std::round(4 * grading(0.07))), 0.1);
}

TEST(Grading, IsDenserAtItsCentreByItsStrength) {
  // The slope's density at the centre s = 1/2 is 0, so only 1 + strength stands there.
  const Grading grading(0.5, 1, 0.12, 6);
  const double h = 1e-4, at_centre = grading(0.5 + h) - grading(0.5 - h);
  const double at_ends = grading(h) - grading(0) + grading(1) - grading(1 - h);
  EXPECT_NEAR(at_centre / at_ends, 2, 2e-3);  // the bell's tail at the ends is 2e-4
}

TEST(Grading, PlaceIsTheInverse) {
  const Grading grading(0.4, 1, 0.12, 7);
  for (double t : {0.0, 0.13, 0.4, 0.77, 1.0}) EXPECT_NEAR(grading.place(grading(t)), t, 1e-12);
}

}  // namespace
}  // namespace mammotwin
