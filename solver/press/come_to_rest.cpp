#include "solver/press/come_to_rest.h"

#include <utility>

#include "solver/breast/breast_model.h"
#include "solver/gravity/hang.h"

namespace mammotwin {
namespace {

NewtonReport lie_as_imaged(const CompressionProblem& problem, Newton& newton, State& state) {
  NewtonOptions balance;
  balance.max_iterations = 10;
  State imaged = state;
  imaged.x = problem.prone;
  const NewtonReport report = newton.solve(imaged, balance);
  if (report.usable()) state = std::move(imaged);
  return report;
}

}  // namespace

LoadSteppingReport come_to_rest(const CompressionProblem& problem, BreastModel& breast,
                                Newton& newton, State& state) {
  LoadSteppingReport load;
  load.reached = 1;
  const Eigen::Vector3d force = problem.body_force();
  if (force.isZero()) return load;
  NewtonReport imaged;
  if (!problem.pull.isZero() && !problem.prone.empty())
    imaged = lie_as_imaged(problem, newton, state);
  if (!imaged.usable()) load = raise_body_force(breast, newton, force, {}, state);
  load.iterations += imaged.iterations;
  load.indefinite += imaged.indefinite;
  return load;
}

}  // namespace mammotwin
