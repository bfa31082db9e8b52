#pragma once

#include <string>

#include "pipeline/frame/settings.h"

namespace mammotwin {

/// Markdown table of settings: key, type, unit, range, default, meaning. pipeline/README.md holds
/// it, and a test fails where the two differ.
std::string settings_table(const std::vector<Setting>& settings);

}  // namespace mammotwin
