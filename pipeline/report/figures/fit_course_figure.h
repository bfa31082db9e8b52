#pragma once

#include <optional>

#include "pipeline/report/figure.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// How the distance of the data's skin to the mesh fell over the fit's iterations
/// (`skin_rms_by_iteration_mm` of prone.vtu's sidecar); nothing where the fit left none.
std::optional<Figure> fit_course_figure(const PatientResults& results);

}  // namespace mammotwin
