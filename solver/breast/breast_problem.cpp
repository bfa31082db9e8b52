#include "solver/breast/breast_problem.h"

#include <memory>

#include "solver/material/neo_hookean.h"

namespace mammotwin {

TissueLaws TissueLaws::defaults() {
  return {{std::make_shared<NeoHookean>(0.75), std::make_shared<NeoHookean>(2.5),
           std::make_shared<NeoHookean>(3.3)},
          Mixing::geometric};
}

}  // namespace mammotwin
