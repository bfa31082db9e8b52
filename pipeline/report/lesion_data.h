#pragma once

#include <nlohmann/json_fwd.hpp>

#include "registration/export/lesion_table.h"

namespace mammotwin {

/// Rows of the page's table of predicted positions, as text.
nlohmann::json lesion_data(const std::vector<LesionRow>& rows);

}  // namespace mammotwin
