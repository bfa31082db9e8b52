#pragma once

#include <functional>
#include <optional>

#include "registration/search/solved_view.h"

namespace mammotwin {

/// How far solves came on the straight way from one state to another.
struct Walk {
  double share = 0;  ///< of the way
  SolvedView end;    ///< the solution there
};

/// Solves at a share of the way, from a solution near it; empty where no equilibrium is found.
using SolveNear = std::function<std::optional<SolvedView>(const SolvedView& near, double share)>;

/// Goes the whole way at once; where that fails, in steps that are halved until one succeeds or
/// would be shorter than `shortest`, each from the solution before. Plates that move by millimetres
/// at once may push elements inside out that steps do not, and near a loss of stability a solution
/// is found only from close by.
Walk walk(const SolvedView& from, double shortest, const SolveNear& solve);

}  // namespace mammotwin
