#pragma once

#include "fitting/fit_breast.h"
#include "pipeline/frame/outcome.h"

namespace mammotwin {

/// The outcome of a fit: its status and quality figures (design, section 1).
Outcome judge_fit(const FitReport& report);

/// What FitOptions::verbosity asks to be said.
std::string fit_talk(const FitReport& report, int verbosity);

}  // namespace mammotwin
