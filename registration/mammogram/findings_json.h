#pragma once

#include <nlohmann/json_fwd.hpp>

#include "registration/mammogram/header_geometry.h"
#include "registration/mammogram/mammogram_findings.h"

namespace mammotwin {

/// Findings as a program reads them: pixels are (column, row) of the stored image, the rest has its
/// unit in its name.
nlohmann::json findings_json(const MammogramFindings& findings);

/// A view's geometry, and what was assumed or looks odd.
nlohmann::json geometry_json(const HeaderGeometry& geometry);

}  // namespace mammotwin
