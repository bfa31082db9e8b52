#pragma once

#include <optional>

#include "pipeline/report/figure.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Axial and sagittal crops round the place of a doubt of the segmentation (an entry of `doubts` in
/// its sidecar), with the edges of its labels. None without a place or without a segmentation.
std::optional<Figure> doubt_figure(const PatientResults& results, const nlohmann::json& doubt);

}  // namespace mammotwin
