#pragma once

#include "solver/element/tensor_basis.h"

namespace mammotwin {

/// Sum-factorised kernels of one element (layout: tensor_basis.h), compiled for several
/// instruction sets and chosen when the program starts. Plain arrays; no allocation.

/// gradient[64 J + q] = Σₐ ∂φₐ/∂ξ_J (q) coefficients[a].
void gradient_at_points(const double* coefficients, double* gradient);

/// residual[a] += Σ_q Σ_J ∂φₐ/∂ξ_J (q) flux[64 J + q].
void add_gradient_transposed(const double* flux, double* residual);

/// block[a + 64 b] = Σ_q Σ_JL ∂φₐ/∂ξ_J coefficients[64 (3 J + L) + q] ∂φ_b/∂ξ_L.
void tangent_block(const double* coefficients, double* block);

/// matrix += factor factorᵀ, lower triangle (and whatever of the upper is convenient); matrix is
/// 192 x 192, factor 192 x columns, both column by column.
void add_outer_product(const double* factor, int columns, double* matrix);

}  // namespace mammotwin
