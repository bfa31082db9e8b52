#pragma once

#include "solver/load/load_stepping.h"
#include "solver/press/compression_result.h"
#include "solver/press/press.h"

namespace mammotwin {

/// Says in a measured report whether the breast rests between the plates as asked: converged, or
/// the reason why not and how far it came. `load`: of the plates' way.
void judge_compressed(Press& press, const LoadSteppingReport& load, const State& state,
                      CompressionReport& report);

}  // namespace mammotwin
