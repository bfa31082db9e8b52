#pragma once

#include "fitting/solve/plane_samples.h"
#include "fitting/solve/shape_energy.h"

namespace mammotwin {

/// What the fit minimises over all nodal parameters:
///
///   ½ Σ weight (n · (x − target))² + ½ smoothing ∫ Σᵢⱼ |∂²x/∂uᵢ∂uⱼ|² du + shape · mean e(F)
///     + ½ tether ∫ |x − x₀|² + 0.04⁴ Σᵢⱼ |∂²(x − x₀)/∂uᵢ∂uⱼ|² du₁ du₂ over the skin
///
/// u in [0,1]³ runs through the whole slab; the mean of e is ShapeEnergy's. The data hardly decide
/// how a mesh slides along its skin; the tether to where it was, x₀, does. Each element holds a
/// part.
class FitModel {
 public:
  FitModel(const Slab& slab, const HermiteMesh& start);

  void weigh(double shape, double smoothing) {
    shape_weight_ = shape, smoothing_weight_ = smoothing;
  }
  ShapeEnergy& shape_energy() { return shape_energy_; }
  void tether(double weight, const std::vector<HermiteMesh::Node>& to);

  /// Goes to these nodes: new samples, and ε from the smallest determinant.
  void move_to(const std::vector<HermiteMesh::Node>& nodes,
               const std::vector<PlaneSample>& samples);

  /// Of one element's part at the nodes that it was moved to.
  double cost(int element) const;
  ElementQuadratic quadratic(int element) const;

  int num_elements() const { return static_cast<int>(corners_.size()); }

 private:
  int first_at_skin() const { return num_elements() - static_cast<int>(tethered_to_.size()); }
  /// From where the tether holds an element at the skin; nought inside.
  ElementShape strayed(int e) const;

  std::vector<HermiteMesh::Corners> corners_;
  Eigen::Vector3d origin_;  ///< positions are taken from here, for rounding
  double shape_weight_ = 1, smoothing_weight_ = 0;
  double tether_weight_ = 0;
  Eigen::Matrix<double, 64, 64> second_derivatives_, tether_;
  std::vector<ElementShape> tethered_to_;  ///< of the elements at the skin, which are the last
  ShapeEnergy shape_energy_;
  std::vector<ElementShape> shapes_;
  std::vector<PlaneSamples> samples_;
};

}  // namespace mammotwin
