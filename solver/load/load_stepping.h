#pragma once

#include <functional>
#include <string>

#include "solver/newton/newton.h"

namespace mammotwin {

struct LoadSteppingOptions {
  double first_step = 1;            ///< fraction of the load, in (0, 1]
  double smallest_step = 1.0 / 64;  ///< a smaller step is not tried
  int max_iterations = 400;         ///< in all
  double growth = 1.5;              ///< of the step after a success, at least 1
  double largest_step = 1;          ///< fraction of the load
};

struct LoadSteppingReport {
  double reached = 0;  ///< fraction of the load at the last good state
  int steps = 0, cutbacks = 0, iterations = 0, indefinite = 0;
  std::string reason;    ///< why it stopped short
  double next_step = 0;  ///< fraction of the load that is tried next; 0: the first
  bool complete() const { return reached >= 1; }
};

/// Brings a state to equilibrium at a fraction of the load.
using Equilibrate = std::function<NewtonReport(double fraction, State& state)>;

/// Called after every good step.
using StepDone = std::function<void(const LoadSteppingReport& so_far, const State& state,
                                    const NewtonReport& last)>;

/// Raises the load from 0 to 1 with a step that is halved after a failure, from the last good
/// state, and grown after a success. `state` ends at the last good state. `from`: what a StepDone
/// was given, with its state, to go on from there.
LoadSteppingReport step_load(State& state, const LoadSteppingOptions& options,
                             const Equilibrate& equilibrate, const StepDone& step_done,
                             const LoadSteppingReport& from = {});

}  // namespace mammotwin
