#pragma once

#include <array>

#include "registration/search/view_state.h"

namespace mammotwin {

/// A number of a view's state that a reader may vary, to either side of where it was solved.
struct WhatIf {
  StateNumber number;
  double range;  ///< in the number's unit
};

/// Within these ranges reduced views have been compared with full solves
/// (pipeline/evaluate/registration/what_if_rows.h).
inline constexpr std::array<WhatIf, 4> kWhatIf = {
    {{kThickness, 3}, {kRoll, 3}, {kStiffnessRatio, 0.45}, {kClearance, 3}}};

/// How far tissue then lies from where full solves put it on the detector [mm]: the row `slopes` of
/// docs/measured/what_if.md, of the sample patient alone; a test holds the two together.
inline constexpr double kWhatIfMedian_mm = 0, kWhatIfP95_mm = 0;

}  // namespace mammotwin
