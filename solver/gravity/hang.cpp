#include "solver/gravity/hang.h"

#include <algorithm>

#include "solver/breast/breast_model.h"

namespace mammotwin {

HangOptions to_another_pose() {
  HangOptions options;
  options.load.smallest_step = 1.0 / 16;
  options.load.max_iterations = options.step_iterations = 200;
  return options;
}

LoadSteppingReport raise_body_force(BreastModel& breast, Newton& newton,
                                    const Eigen::Vector3d& body_force, const HangOptions& options,
                                    State& state) {
  NewtonOptions balance;
  balance.tolerance = options.tolerance;
  balance.constraint_tolerance = options.tolerance;
  balance.max_iterations = options.step_iterations;
  return step_load(
      state, options.load,
      [&](double fraction, State& trial) {
        breast.model->set_body_force(
            [force = (fraction * body_force).eval()](const Eigen::Vector3d&) { return force; });
        breast.set_skin_share(fraction);
        return newton.solve(trial, balance);
      },
      [](const LoadSteppingReport&, const State&, const NewtonReport&) {});
}

double largest_distance(const std::vector<HermiteMesh::Node>& a,
                        const std::vector<HermiteMesh::Node>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i].col(0) - b[i].col(0)).norm());
  return largest;
}

double rms_distance(const std::vector<HermiteMesh::Node>& a,
                    const std::vector<HermiteMesh::Node>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i].col(0) - b[i].col(0)).squaredNorm();
  return a.empty() ? 0 : std::sqrt(sum / a.size());
}

HangResult hang(const BreastProblem& problem, const HangOptions& options) {
  BreastModel breast = make_breast_model(problem, options.solid);
  Newton newton(*breast.model, *breast.dofs);
  State state = breast.model->rest();
  const LoadSteppingReport load =
      raise_body_force(breast, newton, problem.density * problem.gravity, options, state);
  const Balance balance = newton.balance(state);
  HangReport report;
  report.converged = load.complete();
  report.reason = load.reason;
  report.gravity_fraction = load.reached;
  report.steps = load.steps;
  report.newton_iterations = load.iterations;
  report.sag_max_mm = largest_distance(state.x, problem.mesh.mesh.nodes());
  report.min_J = balance.min_J;
  report.max_J = balance.max_J;
  return {std::move(state.x), report};
}

}  // namespace mammotwin
