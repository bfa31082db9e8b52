#pragma once

namespace mammotwin {

/// Dense kernels on column-major lower triangles, tiled in a fixed way and run in parallel where
/// the work is worth it.

/// Cholesky of the leading `pivots` columns of a panel of `rows` rows: the pivot block becomes L₁,
/// the rows below L₂ = A₂ L₁⁻ᵀ. False where it is not positive definite.
bool factor_panel(double* panel, int rows, int pivots);

/// update = −L₂ L₂ᵀ, lower triangle; L₂ is `size` x `pivots` inside a panel of `stride` rows.
void negative_outer_product(const double* L2, int stride, int size, int pivots, double* update);

/// x = L₁⁻¹ x and x = L₁⁻ᵀ x for the pivot block of a panel.
void solve_lower(const double* panel, int rows, int pivots, double* x);
void solve_lower_transposed(const double* panel, int rows, int pivots, double* x);

}  // namespace mammotwin
