#pragma once

#include <nlohmann/json.hpp>

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// One view as a function of the numbers of registration/search/what_if.h, for the page's sliders:
/// material points (lesions, corners of their outlines, nipple) as in ReducedView, the skin's
/// outline along rays, and what an ellipse is computed from. Null where `register` left no
/// sensitivities.
nlohmann::json what_if_data(const PatientResults& results, const ViewResult& view);

/// What the sliders' model is worth.
std::string what_if_words();

}  // namespace mammotwin
