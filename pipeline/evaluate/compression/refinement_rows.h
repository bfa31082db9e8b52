#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "pipeline/evaluate/cases/breasts_to_press.h"

namespace mammotwin {

/// Presses the breast, from the shape in which it was imaged, with a mesh of each of these numbers
/// of elements ("7x7x2"; "default": what `fit` chooses), the finest, which the others are compared
/// with, first, and gives `add` a line a mesh and view: `lesion_median_mm`, `lesion_max_mm`,
/// `tissue_median_mm`, `tissue_max_mm` (moves of lesions and 50 points relative to the nipple),
/// `force_N` and `force_change` [fraction], `contact_area_cm2`, `gap_p95_mm`,
/// `max_penetration_mm`, `elements`, `dof`, `newton_iterations`, `cpu_seconds`. What found no
/// equilibrium has a `reason` and nulls.
void add_refinement_rows(const BreastToPress& breast, const std::vector<std::string>& meshes,
                         const std::function<void(const nlohmann::json&)>& add);

}  // namespace mammotwin
