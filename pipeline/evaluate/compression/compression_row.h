#pragma once

#include "pipeline/evaluate/cases/breast_inputs.h"

namespace mammotwin {

/// One compression's line in compression.json. `reached`: the measured thickness within 0.1 mm of
/// the one asked, no point 0.1 mm inside a plate, J within 0.5 to 1.5 at 99 % of the quadrature
/// points. What is not known is null; a compression that did not reach has its `reason`.
/// `possible` is false where the free breast is too thin to be pressed to what is asked.
nlohmann::json compression_row(const EvaluatedBreast& breast, const PreparedBreast& prepared,
                               const AskedView& view, int most_cpu_seconds);

/// Completes a line that has `target_thickness_mm` from the stage's sidecar: figures, and either
/// `reached` or a `reason`.
void judge_row(nlohmann::json& row, const nlohmann::json& sidecar);

}  // namespace mammotwin
