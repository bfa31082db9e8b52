#pragma once

#include <ceres/problem.h>
#include <ceres/solver.h>

namespace mammotwin {

/// When a descent in few numbers ends, and how far its first step may go.
struct DescentLimits {
  int most_iterations;
  double gain;  ///< of the cost: less is converged
  double first_radius;
};

/// Levenberg-Marquardt by Ceres on dense normal equations; returns the number of steps.
inline int descend_dense(ceres::Problem& problem, const DescentLimits& limits) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = limits.most_iterations;
  options.function_tolerance = limits.gain;
  options.initial_trust_region_radius = limits.first_radius;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.num_successful_steps;
}

}  // namespace mammotwin
