#pragma once

#include "fitting/slab/slab.h"
#include "fitting/solve/element_shape.h"
#include "fitting/solve/foldover_energy.h"
#include "fitting/solve/tensor_hessian.h"

namespace mammotwin {

/// Mean over a slab of the foldover-free energy of F = ∂x/∂ξ with column i divided by the length
/// that the element should have along ξᵢ₊₁ (across the skin the mean times what the slab's grading
/// asks, through it the start's), at 5³ Lobatto points an element, all of equal weight (quadrature
/// weights would let corners degenerate). An element may be given emphasis n > 0: its energy counts
/// 4ⁿ times and is taken at 9³ even points, for folds that hide between the 5³.
class ShapeEnergy {
 public:
  ShapeEnergy(const Slab& slab, const HermiteMesh& start);

  void emphasise(int element) { ++emphasis_[element]; }
  int emphasis(int element) const { return emphasis_[element]; }
  void forget_emphasis() { emphasis_.assign(emphasis_.size(), 0); }

  /// Takes ε from the smallest determinant of these elements.
  void renew_epsilon(const std::vector<ElementShape>& elements);

  double cost(const ElementShape& x, int element) const;
  /// Adds `weight` times the element's part.
  void add(const ElementShape& x, int element, double weight, ElementQuadratic& to) const;

 private:
  using Gradients = Eigen::Matrix<double, 3, Eigen::Dynamic>;  ///< column i of F of every point,
                                                               ///< then column i + 1
  const TensorHessian& grid(int element) const { return grids_[emphasis_[element] > 0]; }
  const Eigen::MatrixXd& gradients(int element) const { return gradients_[emphasis_[element] > 0]; }
  Gradients gradients_of(const ElementShape& x, int element) const;
  double smallest_determinant(const ElementShape& x, int element) const;
  double point_weight(int element) const;

  std::vector<int> emphasis_;
  std::array<TensorHessian, 2> grids_;  ///< without and with emphasis
  /// Of these: row i N + q is ∂/∂ξᵢ₊₁ of every basis function at point q of N, scaled.
  std::array<Eigen::MatrixXd, 2> gradients_;
  std::vector<Eigen::Vector3d> stretch_;  ///< of each element: typical length over wanted one
  FoldoverEnergy energy_;
};

}  // namespace mammotwin
