#include "registration/search/view_state.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mammotwin {

ViewState with_swing(ViewState sd, double swing_mm, double nipple_depth_mm) {
  constexpr double least_depth_mm = 30;  // of a nipple at the edge a turn says nothing
  const double half = swing_mm / std::numbers::sqrt2;
  const double turn = half / std::max(least_depth_mm, nipple_depth_mm) * 180 / std::numbers::pi;
  sd[kShiftLateral] = std::hypot(sd[kShiftLateral], half);
  sd[kTurn] = std::hypot(sd[kTurn], turn);
  return sd;
}

}  // namespace mammotwin
