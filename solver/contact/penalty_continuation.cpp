#include "solver/contact/penalty_continuation.h"

#include <algorithm>
#include <limits>

namespace mammotwin {

namespace {

void add(NewtonReport& total, const NewtonReport& part) {
  const int iterations = total.iterations + part.iterations;
  const int indefinite = total.indefinite + part.indefinite;
  total = part;
  total.iterations = iterations;
  total.indefinite = indefinite;
}

/// Newton with the curvature's pressures capped, which only has to come near.
NewtonReport approach(Newton& newton, const NewtonOptions& options, State& state) {
  NewtonOptions near = options;
  near.tolerance = 1e-3;
  near.constraint_tolerance = 1e-2;
  return newton.solve(state, near);
}

}  // namespace

NewtonReport resettle(Newton& newton, PlateContact& contact, const NewtonOptions& options,
                      State& state) {
  NewtonReport total = approach(newton, options, state);
  if (!total.usable()) return total;
  const double cap = contact.curvature_pressure;
  contact.curvature_pressure = std::numeric_limits<double>::infinity();
  add(total, newton.solve(state, options));
  contact.curvature_pressure = cap;
  return total;
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
    contact.penalty *= std::clamp(1.2 * excess, least_growth, most_growth);
    add(total, resettle(newton, contact, options, state));
    if (!total.usable()) return total;
  }
  return total;
}

}  // namespace mammotwin
