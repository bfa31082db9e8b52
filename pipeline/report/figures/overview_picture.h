#pragma once

#include "pipeline/report/drawing/picture.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// The way of one lesion on one sheet: MRI slice with labels and mesh, prone and compressed breast,
/// and the simulated views. Holds whatever exists.
Picture overview_picture(const PatientResults& results);

}  // namespace mammotwin
