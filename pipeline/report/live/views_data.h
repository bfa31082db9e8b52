#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "pipeline/report/figure.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// What the page's scripts know of the hung pictures, each of the view in `of_view`: a name of its
/// own ("cc", of a further slice "cc-2"), the view's, geometry, how the detector lies on the
/// picture, and of a view's first picture what the sliders need.
nlohmann::json views_data(const PatientResults& results, const std::vector<Figure>& hung,
                          const std::vector<const ViewResult*>& of_view);

}  // namespace mammotwin
