#include "solver/load/load_stepping.h"

#include <algorithm>

namespace mammotwin {

LoadSteppingReport step_load(State& state, const LoadSteppingOptions& options,
                             const Equilibrate& equilibrate, const StepDone& step_done,
                             const LoadSteppingReport& from) {
  constexpr double cut = 0.5;
  LoadSteppingReport report = from;
  double step = from.next_step > 0 ? from.next_step : options.first_step;
  while (!report.complete()) {
    if (report.iterations >= options.max_iterations) {
      report.reason += (report.reason.empty() ? "gave up after " : "; gave up after ") +
                       std::to_string(report.iterations) + " iterations";
      return report;
    }
    const double target = report.reached + step > 1 - 1e-9 ? 1 : report.reached + step;
    State trial = state;
    const NewtonReport newton = equilibrate(target, trial);
    report.iterations += newton.iterations;
    report.indefinite += newton.indefinite;
    if (newton.usable()) {
      state = std::move(trial);
      report.reached = target;
      ++report.steps;
      step = std::min({step * options.growth, options.largest_step, 1 - report.reached});
      report.next_step = step;
      step_done(report, state, newton);
      continue;
    }
    ++report.cutbacks;
    step = (target - report.reached) * cut;
    report.reason = newton.reason;
    if (step < options.smallest_step) return report;
  }
  report.reason.clear();
  return report;
}

}  // namespace mammotwin
