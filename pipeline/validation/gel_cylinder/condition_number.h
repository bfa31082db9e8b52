#pragma once

#include "solver/newton/dof_map.h"
#include "solver/newton/model.h"

namespace mammotwin {

/// λ_max / λ_min of the condensed tangent at a state, rows and columns scaled to a unit diagonal
/// (parameters mix mm and mm per ξ), by power and inverse iteration to about 1 %. Infinite where
/// the tangent is not positive definite.
double condition_number(const Model& model, const DofMap& dofs, const State& state);

}  // namespace mammotwin
