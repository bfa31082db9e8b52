#pragma once

#include <string>

#include "pipeline/frame/settings.h"

namespace mammotwin {

/// Markdown table of settings: key, type, range with unit, default, meaning; last those of tables
/// that may stand any number of times. docs/settings.md holds it, and a test fails where the two
/// differ.
std::string settings_table(const Settings& once, const Settings& in_lists);

}  // namespace mammotwin
