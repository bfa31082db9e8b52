#include "solver/contact/penalty_continuation.h"

#include <algorithm>
#include <utility>

namespace mammotwin {

namespace {

void add(NewtonReport& total, const NewtonReport& part) { total = then(total, part); }

NewtonReport settle(Newton& newton, PlateContact& contact, NewtonOptions options, State& state) {
  options.stabilise = [&contact](bool on) { contact.with_curvature = !on; };
  const NewtonReport report = newton.solve(state, options);
  contact.with_curvature = true;
  return report;
}

/// Only has to come near. Friction stays as the last load step left it: of a soft penalty's
/// pressures it is not the load's, and following them circled for ever on a breast of 1.4 l.
NewtonReport approach(Newton& newton, PlateContact& contact, NewtonOptions options, State& state) {
  return settle(newton, contact, loosened(options, 1e-2), state);
}

}  // namespace

NewtonReport then(const NewtonReport& first, NewtonReport second) {
  second.iterations += first.iterations;
  second.indefinite += first.indefinite;
  return second;
}

NewtonReport resettle(Newton& newton, PlateContact& contact, NewtonOptions options, State& state) {
  options.following = contact.follow;
  return settle(newton, contact, std::move(options), state);
}

NewtonReport solve_contact(Newton& newton, PlateContact& contact, double unit,
                           const PenaltyOptions& options, State& state) {
  NewtonReport total;
  for (double factor = options.first;; factor = std::min(factor * options.growth, options.last)) {
    const bool last = factor >= options.last * (1 - 1e-9);
    contact.penalty = factor * unit;
    add(total, last ? resettle(newton, contact, options.newton, state)
                    : approach(newton, contact, options.newton, state));
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
