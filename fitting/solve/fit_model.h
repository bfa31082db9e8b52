#pragma once

#include "fitting/slab/slab.h"
#include "fitting/solve/foldover_energy.h"
#include "fitting/solve/tensor_hessian.h"

namespace mammotwin {

/// One residual √weight · n · (x(ξ) − target) [mm]: the mesh's point wants to lie in a plane.
struct PlaneSample {
  MeshPoint point;
  Eigen::Vector3d normal, target;
  double weight;
};

/// What the fit minimises over all nodal parameters:
///
///   ½ Σ weight (n · (x − target))² + ½ sobolev ∫ Σᵢⱼ |∂²x/∂uᵢ∂uⱼ|² du + mu · mean e(F)
///
/// u in [0,1]³ runs through the whole slab; e is the foldover-free energy of F = ∂x/∂ξ with
/// column i divided by the length that the element should have along ξᵢ₊₁ (across the skin the mean
/// times what the slab's grading asks, through it the start's), at 5³ Lobatto points an element,
/// all of equal weight (quadrature weights would let corners degenerate). An element may be given
/// emphasis n > 0: its energy counts 4ⁿ times and is taken at 9³ even points, for folds that hide
/// between the 5³.
class FitModel {
 public:
  static constexpr int element_size = 192;  ///< 24·corner + 3·parameter + component
  using ElementVector = Eigen::Matrix<double, element_size, 1>;
  using ElementMatrix = Eigen::MatrixXd;

  /// Quadratic model of one element's share around the nodes it was made for. The Hessian
  /// leaves out what would make it indefinite.
  struct Quadratic {
    double cost = 0;
    ElementVector gradient = ElementVector::Zero();
    ElementMatrix hessian = ElementMatrix::Zero(element_size, element_size);
  };

  /// `emphasis` has one entry an element.
  FitModel(const Slab& slab, const HermiteMesh& start, double mu, double sobolev,
           std::vector<int> emphasis);

  /// Renews the samples, and ε from the smallest determinant of these nodes.
  void update(const std::vector<HermiteMesh::Node>& nodes, const std::vector<PlaneSample>& samples);

  double cost(const std::vector<HermiteMesh::Node>& nodes, int element) const;
  Quadratic quadratic(const std::vector<HermiteMesh::Node>& nodes, int element) const;

  const std::vector<HermiteMesh::Corners>& elements() const { return elements_; }

 private:
  using Shape = Eigen::Matrix<double, 3, 64>;
  using Gradients = Eigen::Matrix<double, 3, Eigen::Dynamic>;  ///< column i of F of every point,
                                                               ///< then column i + 1
  Shape shape(const std::vector<HermiteMesh::Node>& nodes, int element) const;
  double smallest_determinant(const std::vector<HermiteMesh::Node>& nodes) const;
  const TensorHessian& grid(int element) const { return grids_[emphasis_[element] > 0]; }
  const Eigen::MatrixXd& gradients(int element) const { return gradients_[emphasis_[element] > 0]; }
  Gradients gradients_of(const Shape& x, int element) const;
  /// Adds the energy's gradient and Hessian.
  void add_energy(const Shape& x, int element, Quadratic& to) const;
  double energy_weight(int element) const;  ///< of each of its points

  /// Samples of one element: ½ xᵀ a x − bᵀ x + c over the parameters that they see, 48 on a face.
  struct Linear {
    std::vector<int> parameters;
    Eigen::MatrixXd a;
    Eigen::VectorXd b;
    double c = 0;
    double cost(const ElementVector& x) const;
  };
  static Linear linear(const std::vector<PlaneSample>& samples, const std::vector<int>& of_element,
                       const Eigen::Vector3d& centre);

  std::vector<HermiteMesh::Corners> elements_;
  double mu_, sobolev_;
  Eigen::Vector3d centre_;  ///< positions are taken from here, for rounding
  std::vector<int> emphasis_;
  std::array<TensorHessian, 2> grids_;  ///< without and with emphasis
  /// Of these: row i N + q is ∂/∂ξᵢ₊₁ of every basis function at point q of N, scaled.
  std::array<Eigen::MatrixXd, 2> gradients_;
  Eigen::Matrix<double, 64, 64> smoothing_;
  std::vector<Eigen::Vector3d> stretch_;  ///< of each element: typical length over wanted one
  std::vector<Linear> linear_;
  FoldoverEnergy energy_;
};

}  // namespace mammotwin
