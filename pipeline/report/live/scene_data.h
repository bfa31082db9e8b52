#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// What viewer.js turns: one triangle mesh of the breast's surface with its points in the prone and
/// in each compressed configuration, lesions and nipple, plates. Patient LPS [mm]; arrays of
/// numbers are little-endian float32 and uint32 in base64. Needs the prone mesh and at least one
/// view.
nlohmann::json scene_data(const PatientResults& results);

}  // namespace mammotwin
