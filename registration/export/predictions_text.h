#pragma once

#include <string>
#include <vector>

#include "registration/export/lesion_table.h"

namespace mammotwin {

/// Where each view shows each lesion [mm], as lines for a person; empty where no view has one.
std::string predictions_text(const std::vector<LesionRow>& rows);

}  // namespace mammotwin
