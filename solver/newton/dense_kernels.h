#pragma once

namespace mammotwin {

/// Dense kernels on column-major lower triangles, tiled in a fixed way and run in parallel where
/// the work is worth it.

/// A front's columns of its first `pivots` unknowns, `rows` of them each, column by column: of a
/// symmetric matrix, or of its factor, L₁ above L₂.
template <class Number>
struct PanelOf {
  Number* values;
  int rows, pivots;
};
using Panel = PanelOf<double>;
using ConstPanel = PanelOf<const double>;

/// Cholesky: the pivots' block becomes L₁, the rows below L₂ = A₂ L₁⁻ᵀ. False where it is not
/// positive definite.
bool factor_panel(const Panel& panel);

/// update = kept update − L₂ L₂ᵀ, lower triangle, of as many rows as L₂.
void subtract_outer_product(const Panel& factored, double kept, double* update);

/// x₁ = L₁⁻¹ x₁ and x₂ −= L₂ x₁, of x with the panel's rows.
void solve_lower(const ConstPanel& factored, double* x);

/// x₁ = L₁⁻ᵀ (x₁ − L₂ᵀ x₂).
void solve_lower_transposed(const ConstPanel& factored, double* x);

}  // namespace mammotwin
