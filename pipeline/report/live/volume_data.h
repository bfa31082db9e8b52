#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// What the page's linked planes show, for planes.js: grey values (0 to 255) and labels on one grid
/// round the breast, deflated; the labels' names and colours; lesions and nipple as places to jump
/// to. Every n-th voxel along the finest axes where the grid has more than 6 million, so that a
/// page stays below 20 MB. Needs `results.segmentation`.
nlohmann::json volume_data(const PatientResults& results);

}  // namespace mammotwin
