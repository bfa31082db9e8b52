#pragma once

#include "solver/press/press.h"

namespace mammotwin {

/// At the end of the way: closes contact by stiffer penalties and, in the same solves, moves the
/// paddle until the thickness is `thickness` [mm] and turns it until its spring is balanced. What
/// cannot be bettered stays as it is: the best state found. `penalty`: of the last load step.
/// Returns the iterations spent.
NewtonReport finish_compression(Press& press, double thickness, double penalty, State& state);

}  // namespace mammotwin
