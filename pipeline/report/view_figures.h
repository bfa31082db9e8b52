#pragma once

#include "pipeline/report/figure.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Two cuts through one compressed breast at a lesion, in the view's frame: across the plates
/// (depth and height) and along them (depth and lateral), tissue carried with the deformation.
Figure compressed_figure(const PatientResults& results, const ViewResult& view,
                         const Landmark& lesion);

/// The view as the detector sees it: simulated mammogram (or the breast's shadow where there are no
/// tissue fractions), lesions, nipple, and the baseline's lesions beside them.
Figure detector_figure(const PatientResults& results, const ViewResult& view);

/// The same places on the patient's own mammogram of that view, in the same window.
Figure mammogram_figure(const PatientResults& results, const ViewResult& view,
                        const RealMammogram& real);

}  // namespace mammotwin
