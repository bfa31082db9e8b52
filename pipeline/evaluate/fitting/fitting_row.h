#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "pipeline/evaluate/cases/real_breasts.h"

namespace mammotwin {

/// How `mammotwin-fit` is run in an evaluation.
struct FitRun {
  std::vector<std::string> options;  ///< of the command
  bool again = true;                 ///< a mesh that is up to date, too
};

/// Segments and fits one breast in `folder` by the stages themselves: the quality figures of
/// prone.vtu.json, `status`, `seconds`, `cpu_seconds`, `peak_memory_mb` of the fit, and how far the
/// tissue at the mesh's Gauss points is off the voxels' in volume: `volume_error`,
/// `fat_volume_error`, `fibroglandular_volume_error`, and `lesions` (id, volume_ml, volume_error),
/// as fractions. Where there is no mesh, `reason` says why.
nlohmann::json fitting_row(const RealBreast& breast, const std::filesystem::path& folder,
                           const FitRun& run);

}  // namespace mammotwin
