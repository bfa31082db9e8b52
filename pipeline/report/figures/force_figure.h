#pragma once

#include <optional>

#include "pipeline/report/figure.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Plate force against thickness over the load steps of each view, from `quality.history` of its
/// sidecar (a list of {thickness_mm, force_N}), starting unloaded at `free_thickness_mm`; nothing
/// where no view has two points.
std::optional<Figure> force_figure(const PatientResults& results);

}  // namespace mammotwin
