#include "registration/search/state_walk.h"

#include <algorithm>
#include <utility>

namespace mammotwin {

Walk walk(const SolvedView& from, double shortest, const SolveNear& solve) {
  Walk walk{0, from};
  for (double step = 1; walk.share < 1 && step >= shortest;) {
    const double next = std::min(1.0, walk.share + step);
    if (auto there = solve(walk.end, next))
      walk = {next, *std::move(there)};
    else
      step /= 2;
  }
  return walk;
}

}  // namespace mammotwin
