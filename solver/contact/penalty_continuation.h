#pragma once

#include <functional>

#include "solver/contact/plate_contact.h"
#include "solver/newton/newton.h"

namespace mammotwin {

/// The penalties of one load step, in units of shear modulus / element size, so that nothing is
/// left to tune.
struct PenaltyOptions {
  double first = 0.1;  ///< soft: the active set is found with next to no chatter
  double last = 100;   ///< leaves a penetration of about 1e-3 element sizes
  double growth = 10;
  NewtonOptions newton;
};

/// Two solves as one: the second's outcome, both's iterations.
NewtonReport then(const NewtonReport& first, NewtonReport second);

/// Equilibrium with the plates where they are: solved at a soft penalty, then at stiffer ones from
/// there (paper, section 2.3; plain Newton at the last penalty cycles between active sets).
/// `unit` = shear modulus / element size [kPa/mm]. Iterations are those of all penalties together.
NewtonReport solve_contact(Newton& newton, PlateContact& contact, double unit,
                           const PenaltyOptions& options, State& state);

/// Equilibrium near a state that already is one, after a small change of penalty or plates.
/// Friction's pressures are the state's own in the end.
NewtonReport resettle(Newton& newton, const PlateContact& contact, NewtonOptions options,
                      State& state);

/// Raises the penalty further until the largest penetration is at most `gap_tolerance` [mm] or a
/// stiffer one finds no equilibrium; the last good state and penalty stay.
NewtonReport close_gap(Newton& newton, PlateContact& contact, double gap_tolerance,
                       const std::function<double(const State&)>& penetration,
                       const NewtonOptions& options, State& state);

}  // namespace mammotwin
