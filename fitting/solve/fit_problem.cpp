#include "fitting/solve/fit_problem.h"

#include <algorithm>

#include "fitting/one_blas_thread.h"

namespace mammotwin {

namespace {

constexpr int node_size = 24;
using NodeBlock = Eigen::Matrix<double, node_size, node_size, Eigen::RowMajor>;

/// Residuals 24 k to 24 k + 23 of an element. Its Jacobian Lᵀ is triangular: these see corners k
/// to 7.
class CondensedRows : public ceres::CostFunction {
 public:
  CondensedRows(const FitPoint::Condensed& element, int k) : element_(element), k_(k) {
    set_num_residuals(node_size);
    mutable_parameter_block_sizes()->assign(8 - k, node_size);
  }

  bool Evaluate(const double* const*, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::VectorXd> rows(residuals, node_size);
    rows.setZero();  // the cost stands in the remaining residual where no derivatives are asked
    if (!jacobians) return true;
    rows = element_.residuals.segment<node_size>(node_size * k_);
    for (int n = k_; n < 8; ++n) {
      if (!jacobians[n - k_]) continue;
      Eigen::Map<NodeBlock> to(jacobians[n - k_]);
      to = block(n);
    }
    return true;
  }

 private:
  NodeBlock block(int n) const {
    const auto of_factor =
        element_.factor.block<node_size, node_size>(node_size * n, node_size * k_);
    if (n > k_) return of_factor.transpose();
    return NodeBlock(of_factor.transpose()).triangularView<Eigen::Upper>();
  }

  const FitPoint::Condensed& element_;
  int k_;
};

/// Makes the cost right; nothing moves it.
class RemainingResidual : public ceres::SizedCostFunction<1, node_size> {
 public:
  explicit RemainingResidual(const FitPoint& point) : point_(point) {}

  bool Evaluate(const double* const*, double* residual, double** jacobians) const override {
    *residual = point_.remaining_residual();
    if (jacobians && jacobians[0]) std::fill_n(jacobians[0], node_size, 0.0);
    return true;
  }

 private:
  const FitPoint& point_;
};

ceres::Problem::Options with(ceres::EvaluationCallback& callback) {
  ceres::Problem::Options options;
  options.evaluation_callback = &callback;
  return options;
}

ceres::Manifold* without(const std::array<bool, node_size>& held) {
  std::vector<int> constant;
  for (int p = 0; p < node_size; ++p)
    if (held[p]) constant.push_back(p);
  return constant.empty() ? nullptr : new ceres::SubsetManifold(node_size, constant);
}

}  // namespace

void FitProblem::Prepare::PrepareForEvaluation(bool derivatives, bool new_point) {
  if (new_point) point_.move_to(nodes_);
  if (derivatives) point_.linearise();
}

FitProblem::FitProblem(FitPoint& point, const std::vector<HermiteMesh::Corners>& elements,
                       const HeldParameters& held, std::vector<HermiteMesh::Node>& nodes)
    : prepare_(point, nodes), problem_(with(prepare_)) {
  for (std::size_t n = 0; n < nodes.size(); ++n)
    problem_.AddParameterBlock(nodes[n].data(), node_size, without(held[n]));
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (int k = 0; k < 8; ++k) {
      std::vector<double*> seen;
      for (int n = k; n < 8; ++n) seen.push_back(nodes[elements[e][n]].data());
      const auto& condensed = point.condensed(static_cast<int>(e));
      problem_.AddResidualBlock(new CondensedRows(condensed, k), nullptr, seen);
    }
  problem_.AddResidualBlock(new RemainingResidual(point), nullptr, nodes[0].data());
}

ceres::Solver::Summary FitProblem::solve(const ceres::Solver::Options& options) {
  const OneBlasThread one_thread;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
  return summary;
}

ceres::Solver::Options FitProblem::options() {
  ceres::Solver::Options options;
  options.trust_region_strategy_type = ceres::DOGLEG;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  options.jacobi_scaling = false;  // the dog leg scales by the Hessian's diagonal itself
  options.num_threads = 1;         // sums of several threads differ in their last bits
  options.update_state_every_iteration = true;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 0;
  return options;
}

}  // namespace mammotwin
