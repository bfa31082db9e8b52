#include "solver/contact/penalty_continuation.h"

#include <algorithm>

namespace mammotwin {

namespace {

void add(NewtonReport& total, const NewtonReport& part) { total = then(total, part); }

/// Only has to come near. Friction stays as the last load step left it: of a soft penalty's
/// pressures it is not the load's, and following them circled for ever on a breast of 1.4 l.
NewtonReport approach(Newton& newton, const NewtonOptions& options, State& state) {
  constexpr double near = 0.3;
  return newton.solve(state, loosened(options, near));
}

}  // namespace

NewtonReport then(const NewtonReport& first, NewtonReport second) {
  second.iterations += first.iterations;
  second.indefinite += first.indefinite;
  return second;
}

NewtonReport resettle(Newton& newton, const PlateContact& contact, NewtonOptions options,
                      State& state) {
  options.following = contact.follow;
  return newton.solve(state, options);
}

NewtonReport solve_contact(Newton& newton, PlateContact& contact, double unit,
                           const PenaltyOptions& options, State& state) {
  NewtonReport total;
  for (double factor = options.first;; factor = std::min(factor * options.growth, options.last)) {
    const bool last = factor >= options.last * (1 - 1e-9);
    contact.penalty = factor * unit;
    add(total, last ? resettle(newton, contact, options.newton, state)
                    : approach(newton, options.newton, state));
    if (last || !total.usable()) return total;
  }
}

NewtonReport close_gap(Newton& newton, PlateContact& contact, double gap_tolerance,
                       const std::function<double(const State&)>& penetration,
                       const NewtonOptions& options, State& state) {
  constexpr double least_growth = 1.5, most_growth = 5;
  constexpr int most_rounds = 8;
  NewtonReport total;
  total.converged = true;
  for (int round = 0; round < most_rounds; ++round) {
    const double excess = penetration(state) / gap_tolerance;
    if (excess <= 1) return total;
    const double growth = std::clamp(1.2 * excess, least_growth, most_growth);
    contact.penalty *= growth;
    State trial = state;
    const double penalty = contact.penalty;
    add(total, resettle(newton, contact, options, trial));
    if (!total.usable()) {  // the gap of the round before is what there is
      contact.penalty = penalty / growth;
      total.converged = true;
      return total;
    }
    state = std::move(trial);
  }
  return total;
}

}  // namespace mammotwin
