#pragma once

#include "pipeline/report/figure.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Axial, sagittal and coronal slices through a point of the prone MRI: above with the labels laid
/// over it, below with the curves in which the mesh cuts the slice. Needs the segmentation.
Figure mri_figure(const PatientResults& results, const Landmark& lesion);

}  // namespace mammotwin
