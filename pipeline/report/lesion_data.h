#pragma once

#include "registration/export/lesion_table.h"

#include <nlohmann/json.hpp>

namespace mammotwin {

/// Rows of the page's table of predicted positions, as text.
nlohmann::json lesion_data(const std::vector<LesionRow>& rows);

}  // namespace mammotwin
