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

/// Newton without the part of the tangent that a curved plate's pressure gives, t ∂²gap/∂x²: far
/// from equilibrium t is the violation's and not the tissue's, and makes the matrix indefinite at
/// strains where nothing is unstable.
NewtonReport without_curvature(Newton& newton, PlateContact& contact, const NewtonOptions& options,
                               State& state) {
  const double cap = contact.curvature_pressure;
  contact.curvature_pressure = 0;
  const NewtonReport report = newton.solve(state, options);
  contact.curvature_pressure = cap;
  return report;
}

/// Only has to come near.
NewtonReport approach(Newton& newton, PlateContact& contact, NewtonOptions options, State& state) {
  options.tolerance = 1e-3;
  options.constraint_tolerance = 1e-2;
  return without_curvature(newton, contact, options, state);
}

}  // namespace

NewtonReport resettle(Newton& newton, PlateContact& contact, const NewtonOptions& options,
                      State& state) {
  constexpr int few = 8;  // quadratic convergence from nearby takes 3 to 5
  NewtonReport total = approach(newton, contact, options, state);
  if (!total.usable()) return total;
  NewtonOptions quick = options;
  quick.max_iterations = few;
  const double cap = contact.curvature_pressure;
  contact.curvature_pressure = std::numeric_limits<double>::infinity();
  State trial = state;
  add(total, newton.solve(trial, quick));
  contact.curvature_pressure = cap;
  if (total.usable())
    state = std::move(trial);
  else  // linear convergence instead
    add(total, without_curvature(newton, contact, options, state));
  return total;
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
