#pragma once

#include <vector>

#include "solver/element/solid_element.h"

namespace mammotwin {

/// Forces on a body that stay as they are while it moves, for each nodal parameter of each element
/// [mN per unit of the parameter]. Empty: none.
using DeadForces = std::vector<SolidElement::Coefficients>;

}  // namespace mammotwin
