#include "registration/search/view_refinement.h"

#include <ceres/cost_function.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "registration/search/dense_descent.h"

namespace mammotwin {
namespace {

constexpr double kDisplacementSd_mm = 2;                        // of the prior
constexpr double kLeastOutline_mm = 0.5, kLeastPattern = 0.25;  // noise, whatever is left
constexpr double kControlNudge = 0.1;                           // of a standard deviation
constexpr int kMostRefinements = 5;
constexpr double kRefinementGain = 0.01;  // of the cost: less is converged
constexpr double kRefinementRadius = 1e4;

/// Over what the detector can see of the view.
FreeFormDeformation deformation_over(const ReducedView& view, const ViewState& z) {
  Eigen::Vector2d low(1e30, 1e30), high = -low;
  for (const HermiteMesh::Node& node : view.nodes_at(z)) {
    low = low.cwiseMin(node.col(0).head<2>());
    high = high.cwiseMax(node.col(0).head<2>());
  }
  low.x() = std::max(low.x(), -z[kShiftDepth] * view.sd[kShiftDepth]);
  return {low, high.cwiseMax(low)};
}

/// L of the controls' prior covariance L L^T, in one direction [mm].
Eigen::MatrixXd prior_factor(const FreeFormDeformation& deformation) {
  const Eigen::Index count = deformation.controls().cols();
  Eigen::MatrixXd covariance(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      covariance(i, j) = std::exp(-(deformation.middle(i) - deformation.middle(j)).squaredNorm() /
                                  (2 * kDisplacementLength_mm * kDisplacementLength_mm));
  covariance.diagonal().array() += 1e-4;  // a Gaussian's matrix is near singular
  return kDisplacementSd_mm * covariance.llt().matrixL().toDenseMatrix();
}

MatchNoise noise_of(const MatchFigures& left) {
  MatchNoise noise{std::max(kLeastOutline_mm, left.outline_rms_mm)};
  if (left.pattern_correlation)
    noise.pattern = std::max(kLeastPattern, std::sqrt(2 * (1 - *left.pattern_correlation)));
  return noise;
}

/// The match's residuals, then the prior's, as functions of controls over their prior.
class DeformationCost : public ceres::CostFunction {
 public:
  DeformationCost(ViewMatch& match, const ViewState& z, const FreeFormDeformation& start)
      : match_(match),
        z_(z),
        noise_(noise_of(match.figures(z))),
        deformation_(start),
        factor_(prior_factor(start)) {
    const int numbers = static_cast<int>(2 * factor_.cols());
    mutable_parameter_block_sizes()->push_back(numbers);
    set_num_residuals(static_cast<int>(residuals(Eigen::VectorXd::Zero(numbers)).size()));
  }

  bool Evaluate(double const* const* parameters, double* residual,
                double** jacobians) const override {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::VectorXd w =
        Eigen::Map<const Eigen::VectorXd>(parameters[0], parameter_block_sizes()[0]);
    const Eigen::VectorXd here = residuals(w);
    Eigen::Map<Eigen::VectorXd>(residual, num_residuals()) = here;
    if (!jacobians || !jacobians[0]) return true;
    Eigen::Map<RowMajor> J(jacobians[0], num_residuals(), w.size());
    for (Eigen::Index i = 0; i < w.size(); ++i)
      J.col(i) = (residuals(w + kControlNudge * Eigen::VectorXd::Unit(w.size(), i)) - here) /
                 kControlNudge;
    return true;
  }

  FreeFormDeformation deformation(const Eigen::VectorXd& w) const {
    FreeFormDeformation moved = deformation_;
    moved.set_controls((factor_ * w.reshaped(factor_.cols(), 2)).transpose());
    return moved;
  }

 private:
  Eigen::VectorXd residuals(const Eigen::VectorXd& w) const {
    match_.deform(deformation(w));
    const Eigen::VectorXd evidence = match_.residuals(z_, true, noise_);
    Eigen::VectorXd all(evidence.size() + w.size());
    all << evidence, w;
    return all;
  }

  ViewMatch& match_;
  const ViewState& z_;
  MatchNoise noise_;
  FreeFormDeformation deformation_;
  Eigen::MatrixXd factor_;
};

/// Displacements of the middles of elements that the detector sees, in a deformed view.
void measure(const ReducedView& view, const ViewState& z, ViewRefinement& refinement) {
  ReducedView before = view;
  before.deformation = {};
  const HermiteMesh mesh(before.nodes_at(z), view.elements);
  double squared = 0;
  int count = 0;
  for (int e = 0; e < mesh.num_elements(); ++e) {
    const Eigen::Vector3d x = mesh.position({e, Eigen::Vector3d::Constant(0.5)});
    if (before.placed(x, z).x() < 0) continue;
    const double moved = view.deformation.at(x.head<2>()).norm();
    squared += moved * moved;
    refinement.most_mm = std::max(refinement.most_mm, moved);
    ++count;
  }
  refinement.rms_mm = std::sqrt(squared / std::max(1, count));
}

}  // namespace

ViewRefinement refine_view(ViewMatch& match, const ViewState& z) {
  auto* cost = new DeformationCost(match, z, deformation_over(match.view(), z));
  Eigen::VectorXd w = Eigen::VectorXd::Zero(cost->parameter_block_sizes()[0]);
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, w.data());
  descend_dense(problem, {kMostRefinements, kRefinementGain, kRefinementRadius});
  ViewRefinement refinement{cost->deformation(w), {}};
  match.deform(refinement.deformation);
  refinement.left = match.figures(z);
  measure(match.view(), z, refinement);
  return refinement;
}

}  // namespace mammotwin
