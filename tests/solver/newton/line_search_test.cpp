#include "solver/newton/line_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace mammotwin {
namespace {

struct Found {
  double fraction = 0;
  int trials = 0;
};

/// As Newton drives it; NaN stands for a state that is not valid.
Found search(const std::function<double(double)>& slope) {
  LineSearch line(slope(0));
  Found found;
  for (; !line.exhausted(); ++found.trials) {
    const double now = slope(line.fraction());
    if (std::isnan(now)) {
      line.go_back();
    } else if (line.overshoots(now)) {
      line.go_back(now);
    } else {
      found.fraction = line.fraction();
      if (line.good_enough(now)) break;
      line.go_farther();
    }
  }
  return found;
}

TEST(LineSearch, TakesTheWholeStepOfAQuadratic) {
  const Found found = search([](double t) { return t - 1; });
  EXPECT_EQ(found.fraction, 1);
  EXPECT_EQ(found.trials, 0);
}

// A wall at 0.4, 1,000 times as stiff as what lies before it: the slope vanishes at 0.4006.
TEST(LineSearch, ComesNearAWallFromBothSides) {
  const Found found = search([](double t) { return t - 1 + 1000 * std::max(0.0, t - 0.4); });
  EXPECT_GT(found.fraction, 0.36);
  EXPECT_LT(found.fraction, 0.402);
  EXPECT_LE(found.trials, 12);
}

TEST(LineSearch, KeepsToTheValidPart) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Found found = search([&](double t) { return t > 0.05 ? nan : -1; });
  EXPECT_GT(found.fraction, 0.03);
  EXPECT_LE(found.fraction, 0.05);
}

TEST(LineSearch, GivesUpWhereNothingIsValid) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Found found = search([&](double t) { return t > 0 ? nan : -1; });
  EXPECT_EQ(found.fraction, 0);
  EXPECT_EQ(found.trials, 14);
}

}  // namespace
}  // namespace mammotwin
