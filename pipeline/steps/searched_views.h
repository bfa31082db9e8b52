#pragma once

#include "pipeline/patient/patient.h"
#include "pipeline/steps/registered_view.h"
#include "registration/search/view_search.h"

namespace mammotwin {

/// Brings every view to its mammogram, where patient.toml names one, and computes how sure
/// positions are in all of them. `views` become the registered ones. Returns for each what the
/// sidecar says of it; what a person should look at is added to `reasons`.
std::map<std::string, nlohmann::json> search_and_register(const Patient& patient,
                                                          const Segmentation& segmentation,
                                                          std::vector<RegisteredView>& views,
                                                          const Progress& progress,
                                                          std::vector<std::string>& reasons);

}  // namespace mammotwin
