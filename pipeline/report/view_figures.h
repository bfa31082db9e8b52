#pragma once

#include "pipeline/report/figure.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Two cuts through one compressed breast at a lesion, in the view's frame: across the plates
/// (depth and height) and along them (depth and lateral), tissue carried with the deformation.
Figure compressed_figure(const PatientResults& results, const ViewResult& view,
                         const Landmark& lesion);

/// The view as the detector sees it, with lesions, search ellipses, nipple, and the baseline's
/// lesions beside them: on the patient's own mammogram where there is one, and last on the
/// simulated one (or the breast's shadow where there are no tissue fractions), all in one window.
std::vector<Figure> detector_figures(const PatientResults& results, const ViewResult& view);

}  // namespace mammotwin
