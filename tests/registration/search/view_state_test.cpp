#include "registration/search/view_state.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

double squared(double x) { return x * x; }
double radians(double degrees) { return degrees * M_PI / 180; }

TEST(ViewState, LaysASwingBackByShiftAndTurnTogether) {
  constexpr double swing = 20, depth = 80;
  const ViewState sd = prior_sd();
  for (const double sign : {1.0, -1.0}) {
    const ViewState wide = with_swing(sd, sign * swing, depth);
    const double shift = squared(wide[kShiftLateral]) - squared(sd[kShiftLateral]);
    const double turn = squared(radians(wide[kTurn])) - squared(radians(sd[kTurn]));
    EXPECT_NEAR(shift, turn * squared(depth), 1e-9);
    EXPECT_NEAR(shift + turn * squared(depth), squared(swing), 1e-9);
    for (int i = 0; i < kStates; ++i)
      if (i != kShiftLateral && i != kTurn) EXPECT_EQ(wide[i], sd[i]);
  }
  EXPECT_EQ(with_swing(sd, 0, depth), sd);
}

// A nipple at the plates' edge, or behind it, says nothing of a turn.
TEST(ViewState, TurnsNoMoreForANippleAtThePlatesEdge) {
  EXPECT_EQ(with_swing(prior_sd(), 20, -5), with_swing(prior_sd(), 20, 30));
}

}  // namespace
}  // namespace mammotwin
