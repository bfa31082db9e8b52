#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/evaluate/cases/breasts_to_press.h"

namespace mammotwin {

/// Presses the breast, from the shape in which it was imaged, in CC and MLO with the weights 0, 5
/// and 10 of the grad-div term (SolidOptions::grad_div), the latter two with its quartic part and
/// without, and gives `add` a line for each: `force_N` and `force_change` [fraction],
/// `lesion_median_mm`, `lesion_max_mm`, `tissue_median_mm` and `tissue_max_mm` (moves of lesions
/// and 50 points relative to the nipple), all against what the breast's own settings say
/// (`is_default`); `min_J`, `max_J`, `J_within_half`, `newton_iterations`, `converged`. What found
/// no equilibrium has a `reason` and nulls.
void add_stabilisation_rows(const BreastToPress& breast,
                            const std::function<void(const nlohmann::json&)>& add);

}  // namespace mammotwin
