#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/evaluate/cases/population.h"
#include "pipeline/evaluate/cases/real_breasts.h"

namespace mammotwin {

/// How `mammotwin-fit` is run in an evaluation.
struct FitRun {
  std::vector<std::string> options;     ///< of the command
  bool again = true;                    ///< a mesh that is up to date, too
  std::filesystem::path other_program;  ///< mammotwin-fit of another build; empty: this one's
};

/// A breast to fit, and how its folder gets its segmentation.
struct BreastToFit {
  std::string name;
  std::string kind;  ///< "patient" or "drawn"
  Side side = Side::left;
  std::function<void(const std::filesystem::path& folder)> segment;
};
BreastToFit to_fit(const RealBreast& breast);
BreastToFit to_fit(const SyntheticBreast& breast);

/// Segments and fits one breast in `folder` by the stages themselves: the quality figures of
/// prone.vtu.json, `status`, `seconds`, `cpu_seconds`, `peak_memory_mb` of the fit, and how far the
/// tissue at the mesh's Gauss points is off the voxels' in volume: `volume_error`,
/// `fat_volume_error`, `fibroglandular_volume_error`, and `lesions` (id, volume_ml, volume_error),
/// as fractions. Where there is no mesh, `reason` says why.
nlohmann::json fitting_row(const BreastToFit& breast, const std::filesystem::path& folder,
                           const FitRun& run);

}  // namespace mammotwin
