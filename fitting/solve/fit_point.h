#pragma once

#include "fitting/solve/fit_model.h"
#include "fitting/solve/fit_samples.h"

namespace mammotwin {

/// What the solver asks of every element.
inline constexpr double needed_scaled_jacobian = 0.1;

/// What a mesh must be for a step to count.
enum class MeshDemand {
  none,
  proved,          ///< det(∂x/∂ξ) > 0 everywhere, by mesh/jacobian_bound.h
  proved_in_shape  ///< and no element loses a scaled Jacobian that it needs
};

/// The fit's cost at one set of nodes, and its Gauss-Newton model there condensed element by
/// element: with the gradient g and the Hessian H = L Lᵀ of an element, its 192 residuals L⁻¹ g and
/// their Jacobian Lᵀ give Ceres the same steps as the thousands of residuals behind them.
/// Elements run in parallel; results do not depend on the number of threads.
class FitPoint {
 public:
  FitPoint(const Slab& slab, const HermiteMesh& start, FitTarget& target);

  FitModel& model() { return model_; }
  void set_weights(const FitTarget::Weights& weights) { weights_ = weights; }
  /// From this mesh on; its elements' shape is what they must keep.
  void demand(MeshDemand demand, const HermiteMesh& mesh);

  /// Nearest points, proof and cost at these nodes.
  void move_to(const std::vector<HermiteMesh::Node>& nodes);
  /// The residuals and Jacobians of all elements there.
  void linearise();

  bool refused() const { return refused_; }  ///< the mesh is not as demanded
  double skin_rms_mm() const { return target_.skin_rms(); }
  /// What is left of √(2 cost) beside the elements' residuals (before `linearise`, all of it). A
  /// mesh that is not as demanded costs more than any other, but not infinitely so: Ceres keeps its
  /// factorisation for the next, shorter step then.
  double remaining_residual() const { return remaining_residual_; }

  struct Condensed {
    ElementVector residuals;
    ElementMatrix factor;  ///< L, lower triangle
  };
  const Condensed& condensed(int element) const { return condensed_[element]; }

 private:
  bool as_demanded(const HermiteMesh& mesh) const;

  std::vector<HermiteMesh::Corners> elements_;
  FitTarget& target_;
  FitModel model_;
  FitTarget::Weights weights_;
  MeshDemand demand_ = MeshDemand::none;
  std::vector<double> shape_to_keep_;
  bool refused_ = false;
  double cost_ = 0, remaining_residual_ = 0;
  std::vector<Condensed> condensed_;
};

}  // namespace mammotwin
