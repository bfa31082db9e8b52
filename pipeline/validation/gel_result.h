#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/validation/gel_case.h"

namespace mammotwin {

/// What a case gave, on all its meshes.
struct GelResult {
  GelCase experiment;
  CylinderFigures figures;              ///< recommended mesh, one load step
  std::vector<CylinderFigures> study;   ///< coarse to fine
  std::vector<CylinderStep> curve;      ///< recommended mesh, many load steps
  std::optional<CylinderFigures> half;  ///< half the cylinder, one plate
};

/// `say` is told what has been run.
GelResult run_gel_case(const GelCase& experiment,
                       const std::function<void(const std::string&)>& say);

/// An entry of validation.json. Numbers that do not exist are null.
nlohmann::json to_json(const GelResult& result);

/// A line a mesh, coarse to fine, the recommended one last: `case`, `mesh`, `unknowns`, `force_N`,
/// `newton_iterations`, `cpu_seconds`, and how far off the other codes it is
/// (`force_off_percent`, `half_width_off_mm`, `radial_strain_off_percent`; null where they have no
/// such figure).
nlohmann::json mesh_rows(const GelResult& result);

/// A sentence for each target that the recommended mesh misses, or that did not converge.
std::vector<std::string> missed_targets(const GelResult& result);

/// found / expected - 1; NaN where nothing is expected.
double relative_error(double found, const std::optional<double>& expected);

}  // namespace mammotwin
