// Newton's ways to know a balanced state that is no minimum and to leave it.

#include <algorithm>
#include <cmath>

#include "solver/newton/newton.h"

namespace mammotwin {

bool Newton::is_stable(const State& state) {
  assembler_.linearise(state, {});
  return cholesky_.factor(assembler_.matrix());
}

/// Inverse iteration with the shifted factor, of unit length in the metric.
Eigen::VectorXd Newton::softest_direction() {
  constexpr int rounds = 8;
  Eigen::VectorXd v = assembler_.right_hand_side();
  const auto apply = [&](const Eigen::VectorXd& x) {
    return multiply(assembler_.pattern(), assembler_.metric(), x);
  };
  if (v.norm() == 0) v.setOnes();
  v = cholesky_.solve(v);
  for (int round = 0; round < rounds; ++round) {
    v = cholesky_.solve(apply(v));
    v /= std::sqrt(v.dot(apply(v)));
  }
  return v;
}

/// From a balanced state that is no minimum down along its softest direction; false where that
/// lowers nothing.
bool Newton::fall(State& state, Balance& balance, const NewtonOptions& options,
                  NewtonReport& report) {
  constexpr double first_length = 1, shortest = 1e-3;  // [mm], of the node that moves most
  assembler_.linearise(state, {});
  for (shift_ = 1e-3; !factor(shift_, report); shift_ *= 4)
    if (shift_ > options.max_shift) return false;
  const auto nodes = assembler_.nodal_step(softest_direction(), {});
  double most = 0;
  for (const auto& node : nodes) most = std::max(most, node.col(0).norm());
  const double start = merit_.value(balance), rounding = CondensedEnergy::rounding(balance);
  for (double length = first_length; length > shortest; length /= 2)
    for (double sign : {1.0, -1.0}) {
      Step step{nodes, {}, 0};
      for (auto& node : step.nodes) node *= sign * length / most;
      step.pressures = assembler_.pressures_after(state, step.nodes);
      const Trial trial = corrected(at(state, step, 1), step, balance, 1);
      if (!(trial.merit < start - rounding)) continue;
      if (options.watch) options.watch(start, trial.merit);
      state = trial.state;
      balance = trial.balance;
      return true;
    }
  return false;
}

}  // namespace mammotwin
