#include "solver/breast/breast_problem.h"

#include <memory>
#include <utility>

#include "solver/material/neo_hookean.h"

namespace mammotwin {

TissueLaws TissueLaws::defaults() {
  return {{std::make_shared<NeoHookean>(0.75), std::make_shared<NeoHookean>(2.5),
           std::make_shared<NeoHookean>(3.3)},
          Mixing::geometric};
}

void scale_load(double factor, BreastProblem& problem) {
  problem.gravity *= factor;
  problem.skin_forces = scaled(std::move(problem.skin_forces), factor);
}

}  // namespace mammotwin
