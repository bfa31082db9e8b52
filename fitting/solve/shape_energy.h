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
///
/// Steep, it is the mean of e + e (e / bad)³, at 6³ points of elements without emphasis: what is
/// badly shaped weighs more by itself, so that none need be picked out for emphasis.
class ShapeEnergy {
 public:
  /// With 4 the synthetic patient's mesh went on to where det(∂x/∂ξ) was a ten-thousandth of its
  /// mean, with 2.5 it stayed above a tenth.
  static constexpr double bad = 2.5;

  ShapeEnergy(const Slab& slab, const HermiteMesh& start);

  void emphasise(int element) { ++emphasis_[element]; }
  int emphasis(int element) const { return emphasis_[element]; }
  void forget_emphasis() { emphasis_.assign(emphasis_.size(), 0); }
  void steepen(bool steep) { steep_ = steep; }
  /// FoldoverEnergy's Hessian that is taken; not while steep.
  void take_gauss_newton(bool take) { gauss_newton_ = take; }

  /// Takes ε from the smallest determinant of these elements.
  void renew_epsilon(const std::vector<ElementShape>& elements);

  double cost(const ElementShape& x, int element) const;
  /// Adds `weight` times the element's part.
  void add(const ElementShape& x, int element, double weight, ElementQuadratic& to) const;

 private:
  using Gradients = Eigen::Matrix<double, 3, Eigen::Dynamic>;  ///< column i of F of every point,
                                                               ///< then column i + 1
  int grid_number(int element) const { return emphasis_[element] > 0 ? 2 : steep_ ? 1 : 0; }
  const TensorHessian& grid(int element) const { return grids_[grid_number(element)]; }
  const Eigen::MatrixXd& gradients(int element) const { return gradients_[grid_number(element)]; }
  Gradients gradients_of(const ElementShape& x, int element) const;
  double smallest_determinant(const ElementShape& x, int element) const;
  double point_weight(int element) const;

  std::vector<int> emphasis_;
  bool steep_ = false, gauss_newton_ = false;
  std::array<TensorHessian, 3> grids_;  ///< plain, steep, with emphasis
  /// Of these: row i N + q is ∂/∂ξᵢ₊₁ of every basis function at point q of N, scaled.
  std::array<Eigen::MatrixXd, 3> gradients_;
  std::vector<Eigen::Vector3d> stretch_;  ///< of each element: typical length over wanted one
  FoldoverEnergy energy_;
};

}  // namespace mammotwin
