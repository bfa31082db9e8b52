#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "pipeline/evaluate/cases/real_breasts.h"
#include "pipeline/evaluate/compression/changed_image.h"

namespace mammotwin {

/// What is asked of one breast.
struct StabilityCase {
  RealBreast breast;
  std::filesystem::path folder;  ///< gets a folder `base` and one for each change
  std::vector<InputChange> changes;
  std::vector<std::string> views = {"cc", "mlo"};
  bool unload = false;  ///< press the shape free of gravity, not the imaged one
};

/// Presses the breast, as it was imaged or unloaded, to 55 mm in each view as it is and with each
/// change, and gives `add` a line a view and change: how far its lesions (`lesion_mm`, the worst;
/// null without any) and 50 points of its tissue (`tissue_median_mm`, `tissue_p95_mm`) lie from
/// where they did, relative to the nipple in the view's frame; `force_change` [fraction], and
/// `swing_mm`, `roll_deg`, iterations and CPU of the changed compression. A line whose compression,
/// or that of the breast as it is, ended without a product has a `reason` and nulls.
void add_stability_rows(const StabilityCase& asked,
                        const std::function<void(const nlohmann::json&)>& add);

}  // namespace mammotwin
