#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// `status`, `verdict` (a sentence), `reasons` (stage, text) and `stages` of the page: the worst
/// status of any stage, or "incomplete" where the chain has not come to its end.
nlohmann::json verdict_data(const PatientResults& results);

}  // namespace mammotwin
