#pragma once

#include "solver/press/press.h"

namespace mammotwin {

struct Finished {
  NewtonReport effort;  ///< iterations of all rounds
  bool let_go = false;
};

/// At the end of the way: closes contact by stiffer penalties and, in the same solves, moves the
/// paddle until the thickness is `thickness` [mm] and turns it until its spring is balanced. What
/// cannot be bettered stays as it is: the best state found. `penalty`: of the last load step.
/// `let_go_below`: of the tissue in front of the plates' edges; a breast of which less stays there
/// is let go where a round fails or it does not settle, for then it slides on and on.
Finished finish_compression(Press& press, double thickness, double penalty, double let_go_below,
                            State& state);

}  // namespace mammotwin
