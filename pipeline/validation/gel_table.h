#pragma once

#include <string>

#include "pipeline/validation/gel_result.h"

namespace mammotwin {

/// The case in words and numbers for a terminal: every mesh against the other codes, the
/// recommended one marked, the curve, and half the cylinder.
std::string gel_table(const GelResult& result);

}  // namespace mammotwin
