#pragma once

#include <array>

#include "registration/search/reduced_view.h"

namespace mammotwin {

/// A number of a view's state that a reader may vary, to either side of where it was solved.
struct WhatIf {
  StateNumber number;
  double range;  ///< in the number's unit
};

inline constexpr std::array<WhatIf, 4> kWhatIf = {
    {{kThickness, 2}, {kRoll, 2}, {kStiffnessRatio, 0.3}, {kClearance, 2}}};

/// How far tissue lies from where full solves put it on the detector [mm], in these ranges: in the
/// best and the worst of so many views of `make evaluate-what-if` (docs/measured/what_if.md; a test
/// compares).
struct WhatIfError {
  double best_mm, worst_mm;
};
inline constexpr WhatIfError kWhatIfMedian{0.3, 0.7}, kWhatIfP95{0.6, 1.7};
inline constexpr int kWhatIfViews = 8;

/// The ranges as a state; 0 for numbers that are not varied.
ViewState what_if_ranges();

/// The breast with one number at either end of its range, as it stands in the registered view's
/// frame, in LPS [mm]. Empty: not known.
struct WhatIfEnds {
  Nodes up, down;
};
using WhatIfShapes = std::array<WhatIfEnds, kWhatIf.size()>;

/// About the state z of a reduced view that stands in `frame`.
WhatIfShapes what_if_shapes(const ReducedView& reduced, const ViewState& z, const ViewFrame& frame);

/// The quadratic through these shapes and `base`, the nodes in the view's frame; its standard
/// deviations are the ranges.
ReducedView what_if_view(const WhatIfShapes& shapes, const HermiteMesh& compressed,
                         const ViewFrame& frame);

}  // namespace mammotwin
