#pragma once

#include "solver/press/compression_problem.h"

namespace mammotwin {

/// The imaged shape, in which points are sought, must be valid everywhere. A shape that was
/// computed from it need only be so at the quadrature points, which the elements check.
/// Throws std::invalid_argument.
void check_shape(const HermiteMesh& solved, const HermiteMesh& imaged);
void check_shape(const CompressionProblem& problem);

}  // namespace mammotwin
