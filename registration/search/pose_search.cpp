#include "registration/search/pose_search.h"

#include <ceres/cost_function.h>
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "registration/search/dense_descent.h"
#include "registration/search/huber.h"

namespace mammotwin {
namespace {

constexpr double kNudge = 0.05;    // of a standard deviation: well above the outline's net
constexpr double kFarthest = 2.5;  // a mechanical number's modes are not believed beyond
constexpr int kMostIterations = 25;
constexpr double kGain = 1e-3;  // of the cost: less is converged
constexpr double kFirstRadius = 100;
// Standard deviations off its mean beyond which a shift in depth costs its distance, not the
// square: real detectors' edges stand centimetres behind the chest wall at times, where the model's
// plates cannot.
constexpr double kShiftTail = 2;

/// All views' numbers in one vector, shared ones once.
class Joint {
 public:
  Joint(std::size_t views, bool only_rigid) : indices_(views) {
    for (int i = 0; i < kStates; ++i)
      for (std::size_t v = 0; v < views; ++v) {
        const bool fixed = only_rigid && i < kMechanical;
        indices_[v][i] = fixed ? -1 : shared_by_views(i) && v > 0 ? indices_[0][i] : size_++;
      }
  }
  int size() const { return size_; }
  ViewState state(std::size_t view, const Eigen::VectorXd& z) const {
    ViewState state = ViewState::Zero();
    for (int i = 0; i < kStates; ++i)
      if (indices_[view][i] >= 0) state[i] = z[indices_[view][i]];
    return state;
  }
  void set(std::size_t view, const ViewState& state, Eigen::VectorXd& z) const {
    for (int i = 0; i < kStates; ++i)
      if (indices_[view][i] >= 0) z[indices_[view][i]] = state[i];
  }
  Eigen::Matrix<double, kStates, kStates> covariance(std::size_t view,
                                                     const Eigen::MatrixXd& all) const {
    Eigen::Matrix<double, kStates, kStates> c;
    for (int i = 0; i < kStates; ++i)
      for (int j = 0; j < kStates; ++j) {
        const int a = indices_[view][i], b = indices_[view][j];
        c(i, j) = a < 0 || b < 0 ? 0 : all(a, b);
      }
    return c;
  }
  Eigen::VectorXd prior_residuals(const Eigen::VectorXd& z,
                                  const std::vector<const ViewMatch*>& views) const {
    Eigen::VectorXd r = z;
    for (std::size_t v = 0; v < views.size(); ++v) {
      const ReducedView& view = views[v]->view();
      const ViewState off = view.edge.deviations(state(v, z).cwiseProduct(view.sd));
      for (const int i : {kTurn, kShiftDepth, kShiftLateral}) r[indices_[v][i]] = off[i];
      r[indices_[v][kShiftDepth]] = huber(off[kShiftDepth], kShiftTail);
    }
    return r;
  }
  /// Ceres starts from nothing that lies outside.
  void bound(ceres::Problem& problem, double* z) const {
    for (const auto& view : indices_)
      for (int i = 0; i < kMechanical; ++i)
        if (view[i] >= 0) {
          z[view[i]] = std::clamp(z[view[i]], -kFarthest, kFarthest);
          problem.SetParameterLowerBound(z, view[i], -kFarthest);
          problem.SetParameterUpperBound(z, view[i], kFarthest);
        }
  }

 private:
  std::vector<std::array<int, kStates>> indices_;
  int size_ = 0;
};

/// The prior's residuals, then those of each view.
class Residuals {
 public:
  Residuals(const std::vector<const ViewMatch*>& views, const Joint& joint)
      : views_(views), joint_(joint) {}

  Eigen::VectorXd at(const Eigen::VectorXd& z, bool with_pattern) const {
    std::vector<Eigen::VectorXd> parts(views_.size());
    Eigen::Index size = z.size();
    for (std::size_t v = 0; v < views_.size(); ++v) {
      parts[v] = views_[v]->residuals(joint_.state(v, z), with_pattern);
      size += parts[v].size();
    }
    Eigen::VectorXd all(size);
    all.head(z.size()) = joint_.prior_residuals(z, views_);
    Eigen::Index row = z.size();
    for (const Eigen::VectorXd& part : parts) {
      all.segment(row, part.size()) = part;
      row += part.size();
    }
    return all;
  }

  Eigen::MatrixXd jacobian(const Eigen::VectorXd& z, bool with_pattern) const {
    Eigen::MatrixXd J(at(z, with_pattern).size(), z.size());
    tbb::parallel_for(Eigen::Index{0}, z.size(), [&](Eigen::Index i) {
      Eigen::VectorXd up = z, down = z;
      up[i] += kNudge;
      down[i] -= kNudge;
      J.col(i) = (at(up, with_pattern) - at(down, with_pattern)) / (2 * kNudge);
    });
    return J;
  }

  /// What the views' residuals count as.
  double observations(bool with_pattern) const {
    double count = 0;
    for (const ViewMatch* view : views_) count += view->observations(with_pattern);
    return count;
  }

 private:
  const std::vector<const ViewMatch*>& views_;
  const Joint& joint_;
};

class PoseCost : public ceres::CostFunction {
 public:
  PoseCost(const Residuals& residuals, const Eigen::VectorXd& z, bool with_pattern)
      : residuals_(residuals), with_pattern_(with_pattern) {
    set_num_residuals(static_cast<int>(residuals.at(z, with_pattern).size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(z.size()));
  }
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Eigen::VectorXd> z(parameters[0], parameter_block_sizes()[0]);
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = residuals_.at(z, with_pattern_);
    if (jacobians && jacobians[0])
      Eigen::Map<RowMajor>(jacobians[0], num_residuals(), z.size()) =
          residuals_.jacobian(z, with_pattern_);
    return true;
  }

 private:
  const Residuals& residuals_;
  bool with_pattern_;
};

class Search {
 public:
  Search(const std::vector<const ViewMatch*>& views, bool only_rigid)
      : joint_(views.size(), only_rigid), residuals_(views, joint_), views_(views.size()) {}

  PoseEstimate run(const std::vector<ViewState>& start, bool only_rigid) {
    Eigen::VectorXd z = joined(start);
    PoseEstimate estimate;
    estimate.iterations = descend(false, z);
    if (!only_rigid) estimate.iterations += descend(true, z);
    describe(z, !only_rigid, estimate);
    return estimate;
  }

  PoseEstimate at(const std::vector<ViewState>& states) {
    PoseEstimate estimate;
    describe(joined(states), true, estimate);
    return estimate;
  }

 private:
  Eigen::VectorXd joined(const std::vector<ViewState>& states) const {
    Eigen::VectorXd z = Eigen::VectorXd::Zero(joint_.size());
    for (std::size_t v = 0; v < views_; ++v) joint_.set(v, states[v], z);
    return z;
  }

  void describe(const Eigen::VectorXd& z, bool with_pattern, PoseEstimate& estimate) const {
    const Eigen::VectorXd r = residuals_.at(z, with_pattern);
    estimate.cost = 0.5 * r.squaredNorm();
    const Eigen::MatrixXd J = residuals_.jacobian(z, with_pattern);
    const auto prior_rows = J.topRows(z.size());
    const Eigen::MatrixXd prior = prior_rows.transpose() * prior_rows;
    const Eigen::MatrixXd evidence = J.transpose() * J - prior;
    const double found = (evidence + prior).ldlt().solve(evidence).trace();  // numbers
    estimate.evidence_variance = std::max(
        1.0, (kOwnObservations + r.tail(r.size() - z.size()).squaredNorm()) /
                 (kOwnObservations + std::max(0.0, residuals_.observations(with_pattern) - found)));
    const Eigen::MatrixXd left = (evidence / estimate.evidence_variance + prior)
                                     .ldlt()
                                     .solve(Eigen::MatrixXd::Identity(z.size(), z.size()));
    for (std::size_t v = 0; v < views_; ++v) {
      estimate.states.push_back(joint_.state(v, z));
      estimate.covariances.push_back(joint_.covariance(v, left));
    }
  }

  /// To the nearest minimum; returns the number of iterations.
  int descend(bool with_pattern, Eigen::VectorXd& z) const {
    ceres::Problem problem;
    problem.AddResidualBlock(new PoseCost(residuals_, z, with_pattern), nullptr, z.data());
    joint_.bound(problem, z.data());
    return descend_dense(problem, {kMostIterations, kGain, kFirstRadius});
  }

  Joint joint_;
  Residuals residuals_;
  std::size_t views_;
};

}  // namespace

PoseEstimate search_pose(const std::vector<const ViewMatch*>& views,
                         const std::vector<ViewState>& start, bool only_rigid) {
  return Search(views, only_rigid).run(start, only_rigid);
}

PoseEstimate pose_at(const std::vector<const ViewMatch*>& views,
                     const std::vector<ViewState>& states) {
  return Search(views, false).at(states);
}

Eigen::Matrix<double, kStates, kStates> prior_covariance() {
  Eigen::Matrix<double, kStates, kStates> c = Eigen::Matrix<double, kStates, kStates>::Identity();
  c(kShiftLateral, kShiftLateral) = 0;
  return c;
}

}  // namespace mammotwin
