#pragma once

#include <nlohmann/json.hpp>

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// How tissue is carried between MRI and views, on grids of `kCarryStep_mm` from which the page's
/// scripts interpolate: {"prone_from": {"cc": grid, ...}, "from_prone": {"cc": grid, ...}}. A grid
/// has `size`, `spacing`, `origin` [mm, of the frame that it starts from: a view's or LPS],
/// `middle` and, deflated, `values`: three 16-bit numbers a node, steps of `step` mm from `middle`
/// in the frame that it leads to; -32768: no tissue is near. `inside` is 1 where the node itself
/// lies in the breast, so that a place counts as in it where the interpolated share reaches half.
nlohmann::json carry_data(const PatientResults& results);

inline constexpr double kCarryStep_mm = 4;

}  // namespace mammotwin
