#pragma once

#include <array>

#include "registration/search/view_state.h"

namespace mammotwin {

/// A number of a view's state that a reader may vary, to either side of where it was solved.
struct WhatIf {
  StateNumber number;
  double range;  ///< in the number's unit
};

/// The ranges that evaluate-what-if presses views in
/// (pipeline/evaluate/registration/what_if_rows.h).
inline constexpr std::array<WhatIf, 4> kWhatIf = {
    {{kThickness, 3}, {kRoll, 3}, {kStiffnessRatio, 0.45}, {kClearance, 3}}};

/// How far tissue lay from where full solves put it on the detector [mm], on the sample patient's
/// CC with 4 x 4 x 1 elements, in ranges of 3 mm, 4 degrees, 0.7 and 4 mm
/// (docs/measured/notes/report.md).
inline constexpr double kWhatIfMedian_mm = 1.0, kWhatIfP95_mm = 3.5;

}  // namespace mammotwin
