#pragma once

#include <vector>

#include "fitting/solve/element_shape.h"

namespace mammotwin {

/// One residual √weight · n · (x(ξ) − target) [mm]: the mesh's point wants to lie in a plane.
struct PlaneSample {
  MeshPoint point;
  Eigen::Vector3d normal, target;
  double weight;
  /// What a robust loss counts beyond the residual's square [mm²]; its derivatives are the same.
  double beyond_square = 0;
};

/// ½ Σ weight (n · (x − target))² of one element's samples as ½ xᵀ a x − bᵀ x + c over the
/// parameters that they see, 48 where all lie on a face.
class PlaneSamples {
 public:
  PlaneSamples() = default;
  /// Those of `samples` whose indices are in `of_element`; positions are taken from `origin`.
  PlaneSamples(const std::vector<PlaneSample>& samples, const std::vector<int>& of_element,
               const Eigen::Vector3d& origin);

  double cost(const ElementVector& x) const;
  void add(const ElementVector& x, ElementQuadratic& to) const;

 private:
  std::vector<int> parameters_;
  Eigen::MatrixXd a_;
  Eigen::VectorXd b_;
  double c_ = 0;
};

}  // namespace mammotwin
