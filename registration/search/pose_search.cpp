#include "registration/search/pose_search.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "registration/search/huber.h"

namespace mammotwin {
namespace {

constexpr double kNudge = 0.05;    // of a standard deviation: well above the outline's net
constexpr double kFarthest = 2.5;  // a mechanical number's modes are not believed beyond
constexpr int kMostIterations = 25;
constexpr double kGain = 1e-3;  // of the cost: less is converged
// Standard deviations beyond which a shift in depth costs its distance, not the square: real
// detectors' edges stand centimetres behind the chest wall at times, where the model's plates
// cannot.
constexpr double kShiftTail = 2;
constexpr double kOwnObservations = 10;  // what the evidence's stated standard deviations count as

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
  Eigen::VectorXd prior_residuals(const Eigen::VectorXd& z) const {
    Eigen::VectorXd r = z;
    for (const auto& view : indices_)
      r[view[kShiftDepth]] = huber(z[view[kShiftDepth]], kShiftTail);
    return r;
  }
  void bound(Eigen::VectorXd& z) const {
    for (const auto& view : indices_)
      for (int i = 0; i < kMechanical; ++i)
        if (view[i] >= 0) z[view[i]] = std::clamp(z[view[i]], -kFarthest, kFarthest);
  }

 private:
  std::vector<std::array<int, kStates>> indices_;
  int size_ = 0;
};

class Search {
 public:
  Search(const std::vector<const ViewMatch*>& views, bool only_rigid)
      : views_(views), joint_(views.size(), only_rigid) {}

  PoseEstimate run(const std::vector<ViewState>& start, bool only_rigid) {
    Eigen::VectorXd z = joined(start);
    PoseEstimate estimate;
    for (const bool with_pattern : {false, true}) {
      if (with_pattern && only_rigid) break;
      descend(with_pattern, z, estimate);
    }
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
    for (std::size_t v = 0; v < views_.size(); ++v) joint_.set(v, states[v], z);
    return z;
  }

  void describe(const Eigen::VectorXd& z, bool with_pattern, PoseEstimate& estimate) const {
    const Eigen::VectorXd r = residuals(z, with_pattern);
    estimate.cost = 0.5 * r.squaredNorm();
    const Eigen::MatrixXd J = jacobian(z, with_pattern);
    const auto prior_rows = J.topRows(z.size());
    const Eigen::MatrixXd prior = prior_rows.transpose() * prior_rows;
    const Eigen::MatrixXd evidence = J.transpose() * J - prior;
    const double found = (evidence + prior).ldlt().solve(evidence).trace();  // numbers
    estimate.evidence_variance =
        std::max(1.0, (kOwnObservations + r.tail(r.size() - z.size()).squaredNorm()) /
                          (kOwnObservations + std::max(0.0, observations(with_pattern) - found)));
    const Eigen::MatrixXd left = (evidence / estimate.evidence_variance + prior).inverse();
    for (std::size_t v = 0; v < views_.size(); ++v) {
      estimate.states.push_back(joint_.state(v, z));
      estimate.covariances.push_back(joint_.covariance(v, left));
    }
  }

  double observations(bool with_pattern) const {
    double count = 0;
    for (const ViewMatch* view : views_) count += view->observations(with_pattern);
    return count;
  }

  Eigen::VectorXd residuals(const Eigen::VectorXd& z, bool with_pattern) const {
    std::vector<Eigen::VectorXd> parts(views_.size());
    Eigen::Index size = z.size();
    for (std::size_t v = 0; v < views_.size(); ++v) {
      parts[v] = views_[v]->residuals(joint_.state(v, z), with_pattern);
      size += parts[v].size();
    }
    Eigen::VectorXd all(size);
    all.head(z.size()) = joint_.prior_residuals(z);
    Eigen::Index at = z.size();
    for (const Eigen::VectorXd& part : parts) {
      all.segment(at, part.size()) = part;
      at += part.size();
    }
    return all;
  }

  Eigen::MatrixXd jacobian(const Eigen::VectorXd& z, bool with_pattern) const {
    Eigen::MatrixXd J(residuals(z, with_pattern).size(), z.size());
    tbb::parallel_for(Eigen::Index{0}, z.size(), [&](Eigen::Index i) {
      Eigen::VectorXd up = z, down = z;
      up[i] += kNudge;
      down[i] -= kNudge;
      J.col(i) = (residuals(up, with_pattern) - residuals(down, with_pattern)) / (2 * kNudge);
    });
    return J;
  }

  void descend(bool with_pattern, Eigen::VectorXd& z, PoseEstimate& estimate) const {
    double damping = 1e-2;
    Eigen::VectorXd r = residuals(z, with_pattern);
    for (int i = 0; i < kMostIterations; ++i, ++estimate.iterations) {
      const Eigen::MatrixXd J = jacobian(z, with_pattern);
      const Eigen::MatrixXd normal = J.transpose() * J;
      const double before = r.squaredNorm();
      bool better = false;
      for (int tries = 0; tries < 8 && !better; ++tries) {
        Eigen::MatrixXd damped = normal;
        damped.diagonal() *= 1 + damping;
        Eigen::VectorXd trial = z - damped.ldlt().solve(J.transpose() * r);
        joint_.bound(trial);
        const Eigen::VectorXd there = residuals(trial, with_pattern);
        better = there.squaredNorm() < before;
        damping *= better ? 0.3 : 4;
        if (better) {
          z = trial;
          r = there;
        }
      }
      if (!better || before - r.squaredNorm() < kGain * before) break;
    }
  }

  const std::vector<const ViewMatch*>& views_;
  Joint joint_;
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
  for (const int i : {kTurn, kShiftLateral}) c(i, i) = 0;
  return c;
}

}  // namespace mammotwin
