#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Everything that page.html shows, by the names that it uses; pictures as data URIs.
nlohmann::json page_data(const PatientResults& results, const std::string& version);

}  // namespace mammotwin
