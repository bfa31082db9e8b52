#pragma once

#include <map>
#include <optional>
#include <string>

#include "pipeline/frame/outcome.h"
#include "pipeline/patient/gravity_settings.h"
#include "solver/gravity/fit_stiffness.h"

namespace mammotwin {

/// The unloaded breast in another pose.
struct PoseState {
  HangResult result;
  double wall_slide_mm = 0;  ///< largest way of a chest-wall node
};

/// What the stage did, for the sidecar.
struct UnloadingRecord {
  Pose imaged = Pose::prone;
  double stiffness_factor = 1;
  std::optional<StiffnessFit> stiffness_fit;
  UnloadReport report;
  std::map<std::string, PoseState> poses;  ///< "standing", "supine"
};

Outcome judge_unloading(const UnloadingRecord& record);

}  // namespace mammotwin
