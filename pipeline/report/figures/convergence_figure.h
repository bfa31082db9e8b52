#pragma once

#include <optional>

#include "pipeline/report/figure.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Newton iterations of each load step of each view, and of the correction at the end, from
/// `quality.history` and `quality.newton_iterations` of its sidecar; nothing where none has any.
std::optional<Figure> convergence_figure(const PatientResults& results);

}  // namespace mammotwin
