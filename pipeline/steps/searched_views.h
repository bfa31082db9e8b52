#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/patient/patient.h"
#include "pipeline/steps/registered_view.h"
#include "registration/search/view_search.h"

namespace mammotwin {

/// Views after the search.
struct RegisteredViews {
  std::vector<RegisteredView> views;
  std::map<std::string, nlohmann::json> figures;  ///< what the sidecar says of each search
  std::vector<std::string> remarks;               ///< what a person should look at
};

/// Brings every view to its mammogram, where patient.toml names one, and computes how sure
/// positions are in all of them.
RegisteredViews search_and_register(const Patient& patient, const Segmentation& segmentation,
                                    std::vector<RegisteredView> views, const Progress& progress);

}  // namespace mammotwin
