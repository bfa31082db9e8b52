#pragma once

#include <nlohmann/json.hpp>

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// How far such predictions have been checked: stands beside every search ellipse.
inline constexpr const char* kAccuracyWords =
    "Accuracy has been measured on synthetic patients only; published methods lie 5 to 13 mm from "
    "the truth on real ones.";

/// The page's first words: a list of lesions, each {"lesion", "place", "views": [{"view", "where",
/// "search", "full"}]}, in a report's language. `full` is the ellipse on a mammogram that was not
/// there to be searched, else empty. Empty without rows of lesions.csv.
nlohmann::json answer_data(const PatientResults& results);

}  // namespace mammotwin
