#pragma once

#include "fitting/solve/plane_samples.h"
#include "fitting/solve/shape_energy.h"

namespace mammotwin {

/// What the fit minimises over all nodal parameters:
///
///   ½ Σ weight (n · (x − target))² + ½ smoothing ∫ Σᵢⱼ |∂²x/∂uᵢ∂uⱼ|² du + shape · mean e(F)
///
/// u in [0,1]³ runs through the whole slab; the mean of e is ShapeEnergy's. All of it is half a sum
/// of squares, of which each element holds a part.
class FitModel {
 public:
  FitModel(const Slab& slab, const HermiteMesh& start);

  void weigh(double shape, double smoothing) {
    shape_weight_ = shape, smoothing_weight_ = smoothing;
  }
  ShapeEnergy& shape_energy() { return shape_energy_; }

  /// Goes to these nodes: new samples, and ε from the smallest determinant.
  void move_to(const std::vector<HermiteMesh::Node>& nodes,
               const std::vector<PlaneSample>& samples);

  /// Of one element's part at the nodes that it was moved to.
  double cost(int element) const;
  ElementQuadratic quadratic(int element) const;

  int num_elements() const { return static_cast<int>(corners_.size()); }

 private:
  std::vector<HermiteMesh::Corners> corners_;
  Eigen::Vector3d origin_;  ///< positions are taken from here, for rounding
  double shape_weight_ = 1, smoothing_weight_ = 0;
  Eigen::Matrix<double, 64, 64> second_derivatives_;
  ShapeEnergy shape_energy_;
  std::vector<ElementShape> shapes_;
  std::vector<PlaneSamples> samples_;
};

}  // namespace mammotwin
