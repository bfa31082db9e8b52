#pragma once

#include "solver/load/load_stepping.h"
#include "solver/newton/newton.h"
#include "solver/press/compression_problem.h"

namespace mammotwin {

struct BreastModel;

/// Brings the breast to rest under its weight and pull, from the state on, with no plates. One that
/// is drawn forward is sought near where it was imaged first; one that a coil's plates pressed
/// then, and no longer do, is not found there. Iterations are those of both tries.
LoadSteppingReport come_to_rest(const CompressionProblem& problem, BreastModel& breast,
                                Newton& newton, State& state);

}  // namespace mammotwin
