#pragma once

#include <map>
#include <optional>
#include <string>

#include "pipeline/frame/outcome.h"
#include "pipeline/patient/gravity_settings.h"
#include "pipeline/steps/coil_release.h"
#include "solver/gravity/fit_stiffness.h"

namespace mammotwin {

/// The unloaded breast in another pose.
struct PoseState {
  HangResult result;
  double wall_slide_mm = 0;  ///< largest way of a chest-wall node
  double move_mm = 0;        ///< largest way of a node from where it was imaged
};

/// What the stage did, for the sidecar.
struct UnloadingRecord {
  Pose imaged = Pose::prone;
  double stiffness_factor = 1;
  double stiffened = 1;  ///< of that: what the settings' was raised by, so that the breast hangs
  std::optional<StiffnessFit> stiffness_fit;
  UnloadReport report;
  std::optional<PressedSides> coil;
  std::optional<CoilRelease> release;      ///< empty: it stays as narrow as imaged
  std::map<std::string, PoseState> poses;  ///< "standing", "supine"
};

/// Where gravity could be taken off in part only, the shape found is that of tissue stiffer by as
/// much under all of it: the record then says so, and is usable. A breast that hangs is at least so
/// stiff, and how soft tissue is, is known least of all. Not beyond eight times
/// the stiffness set, which makes of `real` about the stiffness of `neo_hookean_2026`.
void stiffen_as_needed(UnloadingRecord& record);

Outcome judge_unloading(const UnloadingRecord& record);

}  // namespace mammotwin
