#include "solver/newton/newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/newton/line_search.h"

namespace mammotwin {

namespace {

constexpr double kNearBalance =
    0.02;  // of the flow: from here on the step is trusted by its length

State moved(const State& from, const std::vector<HermiteMesh::Node>& step,
            const std::vector<double>& pressure, double fraction) {
  State to{from.x, pressure};
  for (std::size_t i = 0; i < to.x.size(); ++i) to.x[i] += fraction * step[i];
  return to;
}

bool balanced(const Balance& balance, const NewtonOptions& options) {
  return balance.residual.norm() <= options.tolerance * balance.flow &&
         balance.constraint <= options.constraint_tolerance;
}

bool is_zero(const std::vector<HermiteMesh::Node>& nodes) {
  for (const auto& node : nodes)
    if (!node.isZero(0)) return false;
  return true;
}

NewtonReport& stopped(NewtonReport& report, const Balance& balance, const NewtonOptions& options,
                      bool pending_done, const char* reason) {
  report.converged = pending_done && report.residual <= options.acceptable &&
                     balance.constraint <= options.acceptable;
  if (!report.converged) report.reason = reason;
  return report;
}

}  // namespace

NewtonOptions loosened(NewtonOptions options, double tolerance) {
  options.tolerance = std::max(options.tolerance, tolerance);
  options.constraint_tolerance = std::max(options.constraint_tolerance, tolerance);
  options.acceptable = std::max(options.acceptable, tolerance);
  return options;
}

Newton::Newton(const Model& model, const DofMap& dofs)
    : assembler_(model, dofs), cholesky_(assembler_.pattern(), dofs.node_of_equation()) {}

bool Newton::factor(const State& state, const std::vector<HermiteMesh::Node>& pending,
                    Balance& balance, NewtonReport& report) {
  balance = assembler_.linearise(state, shift_, pending);
  if (!std::isfinite(balance.energy)) return false;
  if (cholesky_.factor(assembler_.matrix())) return true;
  ++report.indefinite;
  return false;
}

bool Newton::factor_exact(const State& state, const NewtonOptions& options,
                          const std::vector<HermiteMesh::Node>& pending, Balance& balance,
                          NewtonReport& report) {
  const double shift = std::exchange(shift_, 0);
  if (options.stabilise) options.stabilise(false);
  if (factor(state, pending, balance, report)) return true;
  if (options.stabilise) options.stabilise(true);
  shift_ = shift;
  return false;
}

bool Newton::factor_shifted(const State& state, const NewtonOptions& options,
                            const std::vector<HermiteMesh::Node>& pending, Balance& balance,
                            NewtonReport& report) {
  constexpr double first_shift = 0.05, growth = 4, decay = 0.25;
  constexpr double near_shift = 1e-3;
  const bool near = report.residual < kNearBalance;
  const bool hopeless = !near && (cut_while_indefinite_ || shift_ * decay >= first_shift / 2);
  indefinite_ = true;
  if (damping_ == 0 && !hopeless && factor_exact(state, options, pending, balance, report)) {
    indefinite_ = false;
    return true;
  }
  if (options.stabilise) options.stabilise(!near);
  const double least = near ? near_shift : first_shift;
  shift_ = std::max(damping_, shift_ * decay < least / 2 ? 0 : shift_ * decay);
  if (shift_ == 0 && (near || !options.stabilise)) shift_ = least;
  while (std::isfinite(balance.energy) && shift_ <= options.max_shift) {
    if (factor(state, pending, balance, report)) return true;
    shift_ = shift_ == 0 ? first_shift : shift_ * growth;
  }
  return false;
}

/// Short steps mean that the model is trusted too far: the metric is stiffened as in Levenberg's
/// method, and let go again by full steps.
void Newton::adapt_damping(double fraction) {
  constexpr double poor = 0.1, good = 0.5, first = 1e-3, growth = 4;
  if (fraction < poor)
    damping_ = std::max(first, damping_ * growth);
  else if (fraction > good)
    damping_ = damping_ / growth < first / 2 ? 0 : damping_ / growth;
}

Newton::Step Newton::solve_step(const State& state, const Balance& balance,
                                const std::vector<HermiteMesh::Node>& pending) const {
  Step step;
  step.solution = cholesky_.solve(assembler_.right_hand_side());
  step.nodes = assembler_.nodal_step(step.solution, pending);
  double work;
  step.pressure = assembler_.pressures_after(state, step.nodes, work);
  step.slope = balance.residual.dot(step.solution) + work;
  return step;
}

double Newton::search(State& state, const Step& step, const Balance& before) const {
  LineSearch line(step.slope);
  State best;
  double taken = 0;
  while (!line.exhausted()) {
    State trial = moved(state, step.nodes, step.pressure, line.fraction());
    const Balance balance = assembler_.balance(trial);
    if (!std::isfinite(balance.energy)) {
      line.go_back();
      continue;
    }
    const double slope = balance.residual.dot(step.solution);
    if (line.overshoots(slope) && balance.residual.norm() >= before.residual.norm()) {
      line.go_back(slope);
      continue;
    }
    best = std::move(trial);
    taken = line.fraction();
    if (line.good_enough(slope)) break;
    line.go_farther();
  }
  if (taken > 0) state = std::move(best);
  return taken;
}

NewtonReport Newton::solve(State& state, const NewtonOptions& options,
                           std::vector<HermiteMesh::Node> pending) {
  NewtonReport report;
  Balance balance;
  const auto stop = [&](const char* reason) {
    return stopped(report, balance, options, pending.empty(), reason);
  };
  shift_ = damping_ = 0;
  indefinite_ = cut_while_indefinite_ = false;
  if (is_zero(pending)) pending.clear();
  for (; report.iterations <= options.max_iterations; ++report.iterations) {
    const bool factored = factor_shifted(state, options, pending, balance, report);
    report.residual = balance.flow > 0 ? balance.residual.norm() / balance.flow : 0;
    if (!std::isfinite(balance.energy)) {
      report.reason = "an element is inverted";
      return report;
    }
    if (pending.empty() && balanced(balance, options)) {
      report.converged = true;
      return report;
    }
    if (!factored) return stop("the tangent stays indefinite under the largest shift");
    if (report.iterations == options.max_iterations) break;
    const Step step = solve_step(state, balance, pending);
    const double fraction = search(state, step, balance);
    cut_while_indefinite_ = indefinite_ && fraction < 1;
    if (fraction == 0) return stop("the line search found no valid step");
    if (report.residual < kNearBalance)
      adapt_damping(fraction);
    else
      damping_ = 0;
    for (auto& node : pending) node *= 1 - fraction;
    if (is_zero(pending)) pending.clear();
  }
  return stop("no equilibrium within the allowed iterations");
}

}  // namespace mammotwin
