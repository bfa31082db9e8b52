#pragma once

#include <nlohmann/json_fwd.hpp>

#include "registration/view/detector.h"

namespace mammotwin {

/// What a sidecar says of the detector that a view was registered with: source_distance_mm,
/// support_gap_mm and, of a tomosynthesis volume, slices.
nlohmann::json detector_record(const Detector& detector);

/// The detector of such a record; what it does not say is as by default.
Detector read_detector_record(const nlohmann::json& record);

}  // namespace mammotwin
