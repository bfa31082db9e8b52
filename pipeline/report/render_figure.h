#pragma once

#include "pipeline/report/figure.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Breast seen obliquely from the front, shaded, with the lesions showing through the skin; in a
/// view (not null) compressed and with its plates, else prone.
Figure render_figure(const PatientResults& results, const ViewResult* view);

}  // namespace mammotwin
