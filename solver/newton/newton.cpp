#include "solver/newton/newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/newton/nearest.h"

namespace mammotwin {

namespace {

constexpr double kNearBalance =
    0.02;  // of the flow: from here on the step is trusted by its length
// of the flow: nearer, potentials that hold something fixed follow the state. Farther off, points
// stand deep in a plate, and friction of such pressures would hold all that touches.
constexpr double kFollow = 1;
constexpr double kFarFromBalance = 0.1;  // of the flow
constexpr double kFirstDamping = 0.4;    // shift after a step that no part of lowered the merit

bool balanced(const Balance& balance, const NewtonOptions& options) {
  return balance.residual.norm() <= options.tolerance * balance.flow &&
         balance.constraint <= options.constraint_tolerance;
}

bool is_zero(const std::vector<HermiteMesh::Node>& nodes) {
  for (const auto& node : nodes)
    if (!node.isZero(0)) return false;
  return true;
}

bool acceptable(const NewtonReport& report, const Balance& balance, const NewtonOptions& options) {
  return report.residual <= options.acceptable && balance.constraint <= options.acceptable;
}

NewtonReport& stopped(NewtonReport& report, const Balance& balance, const NewtonOptions& options,
                      bool pending_done, const char* reason) {
  report.converged = pending_done && acceptable(report, balance, options);
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
    : assembler_(model, dofs),
      cholesky_(assembler_.pattern(), dofs.node_of_equation()),
      merit_(model.num_elements()) {}

bool Newton::factor(double shift, NewtonReport& report) {
  ++report.factorisations;
  bool definite;
  if (shift == 0) {
    definite = cholesky_.factor(assembler_.matrix());
  } else {
    std::vector<double> values = assembler_.matrix();
    const auto& metric = assembler_.metric();
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += shift * metric[k];
    definite = cholesky_.factor(values);
  }
  if (!definite) ++report.indefinite;
  return definite;
}

/// Far from balance the exact matrix is seldom positive definite, and is not tried. Where it stays
/// indefinite near balance it is shifted: the convex parts' does not know the way that leads out of
/// an unstable equilibrium.
bool Newton::factor_definite(const State& state, const NewtonOptions& options,
                             const std::vector<HermiteMesh::Node>& pending, NewtonReport& report) {
  constexpr double first_shift = 1e-3, growth = 4, decay = 0.25;
  constexpr int patience = 4;
  const bool near = report.residual < kNearBalance && indefinite_for_ >= patience;
  const bool tried = damping_ == 0 && report.residual < kFarFromBalance;
  if (tried || near) assembler_.linearise(state, pending);
  indefinite_ = !(tried && factor(0, report));
  indefinite_for_ = indefinite_ && report.residual < kNearBalance ? indefinite_for_ + 1 : 0;
  if (!indefinite_) {
    shift_ = 0;
    return true;
  }
  if (!near) assembler_.linearise(state, pending, TangentKind::convex);
  shift_ = std::max(damping_, shift_ * decay < first_shift / 2 ? 0 : shift_ * decay);
  if (shift_ == 0 && near) shift_ = first_shift;
  while (!factor(shift_, report)) {
    shift_ = shift_ == 0 ? first_shift : shift_ * growth;
    if (shift_ > options.max_shift) return false;
  }
  return true;
}

/// Brings what is followed up to the state, and the balance with it; false where it is held.
///
/// Friction whose pressures follow each step can overshoot for ever. Held, it has an energy, and
/// each solve is Tresca's. Its pressures then err by about as much as they did, the other way: half
/// of their change is nearer than all of it.
bool Newton::refresh(const State& state, Balance& balance, const NewtonOptions& options) {
  constexpr double half = 0.5;
  const auto take = [&](double share) {
    options.following.refresh(state, share);
    balance = assembler_.balance(state);
  };
  if (!held_) {
    take(1);
    return true;
  }
  if (!balanced(balance, options)) return false;
  take(half);
  if (balanced(balance, options)) take(1);
  return true;
}

/// Short steps mean that the model is trusted too far: the metric is stiffened as in Levenberg's
/// method, and let go again by full steps.
void Newton::adapt_damping(double fraction) {
  constexpr double poor = 0.25, good = 0.5, first = 1e-3, growth = 4;
  if (fraction < poor)
    damping_ = std::max(first, growth * std::max(damping_, shift_));
  else if (fraction > good)
    damping_ = damping_ / growth < first / 2 ? 0 : damping_ / growth;
}

/// (K + U) x = b by the iteration x ← K⁻¹ (b − U x), where friction's U is about μ of K: to where
/// another round would gain less than the step's own linearisation loses. Where it does not come
/// closer U is left out.
Eigen::VectorXd Newton::circulated(const Eigen::VectorXd& b) const {
  constexpr int most_rounds = 8;
  constexpr double tolerance = 1e-2;
  const Eigen::VectorXd first = cholesky_.solve(b);
  Eigen::VectorXd x = first;
  double last = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const Eigen::VectorXd better = first - cholesky_.solve(assembler_.circulation(x));
    const double change = (better - x).norm();
    if (round > 0 && change > last) return first;
    x = better;
    last = change;
    if (change <= tolerance * x.norm()) break;
  }
  return x;
}

Newton::Step Newton::step_of(const Eigen::VectorXd& solution, const State& state,
                             const Balance& balance,
                             const std::vector<HermiteMesh::Node>& pending) {
  Step step;
  step.nodes = assembler_.nodal_step(solution, pending);
  step.pressures = assembler_.pressures_after(state, step.nodes);
  merit_.admit(step.pressures);
  if (pending.empty())
    step.slope = merit_.slope(balance, step.pressures, balance.residual.dot(solution));
  return step;
}

Newton::Step Newton::solve_step(const State& state, const Balance& balance,
                                const std::vector<HermiteMesh::Node>& pending) {
  const Eigen::VectorXd& right = assembler_.right_hand_side();
  if (following_ && !held_) {
    assembler_.take_circulation(state);
    const Step step = step_of(circulated(right), state, balance, pending);
    if (step.slope < 0 || !pending.empty()) return step;
  }
  return step_of(cholesky_.solve(right), state, balance, pending);
}

Newton::Trial Newton::at(const State& state, const Step& step, double fraction) const {
  Trial trial{state, {}, 0};
  for (std::size_t i = 0; i < state.x.size(); ++i) trial.state.x[i] += fraction * step.nodes[i];
  for (std::size_t i = 0; i < state.pressure.size(); ++i)
    trial.state.pressure[i] +=
        std::min(1.0, fraction) * (step.pressures.pressure[i] - state.pressure[i]);
  trial.balance = assembler_.balance(trial.state);
  trial.merit = merit_.value(trial.balance);
  return trial;
}

/// The trial, moved to where the volume is what the step said it would be.
Newton::Trial Newton::corrected(const Trial& trial, const Step& step, const Balance& before,
                                double fraction) const {
  const Eigen::MatrixXd excess =
      trial.balance.swelling - before.swelling - fraction * step.pressures.rate;
  const auto nodes =
      assembler_.nodal_step(cholesky_.solve(assembler_.against_swelling(excess)), {});
  Trial better{trial.state, {}, 0};
  for (std::size_t i = 0; i < nodes.size(); ++i) better.state.x[i] += nodes[i];
  better.balance = assembler_.balance(better.state);
  better.merit = merit_.value(better.balance);
  return better;
}

/// The trial at a fraction of the step; where it is not `good`, with its volume corrected if the
/// merit is lower so.
Newton::Trial Newton::tried(const State& state, const Step& step, const Balance& before,
                            double fraction, const std::function<bool(const Trial&)>& good) const {
  Trial trial = at(state, step, fraction);
  if (good(trial) || !std::isfinite(trial.merit)) return trial;
  Trial better = corrected(trial, step, before, fraction);
  return better.merit < trial.merit ? better : trial;
}

/// Friction has no merit of its own: what lowers the energy with the pressures of the step's start
/// need not come nearer to a balance with those of its end, nor the reverse. So a step may also
/// bring the whole residual down.
bool Newton::settles(const Trial& trial, const State& state, const Balance& before, double least,
                     const NewtonOptions& options) const {
  constexpr double most_constraint = 1e-3, most_growth = 2;  // of the volume's error
  if (!following_ || held_ || !std::isfinite(trial.merit)) return false;
  options.following.refresh(trial.state, 1);
  const Balance now = assembler_.balance(trial.state);
  options.following.refresh(state, 1);
  return now.residual.norm() / now.flow <= (1 - least) * before.residual.norm() / before.flow &&
         now.constraint <= std::max(most_growth * before.constraint, most_constraint);
}

/// A step whose tangent was stiffer than the energy is along it: doubled while a parabola through
/// the merits says that its lowest place lies farther, and the merit goes down.
double Newton::lengthened(Trial& trial, const State& state, const Step& step,
                          const Balance& before) const {
  constexpr double longest = 16, worth_it = 1.5;
  const double start = merit_.value(before);
  double length = 1;
  while (length < longest) {
    const double curvature = 2 * (trial.merit - start - step.slope * length) / (length * length);
    if (-step.slope < worth_it * length * curvature) break;
    const auto lower = [&](const Trial& other) { return other.merit < trial.merit; };
    Trial farther = tried(state, step, before, 2 * length, lower);
    if (!lower(farther)) break;
    trial = std::move(farther);
    length *= 2;
  }
  return length;
}

double Newton::search(State& state, const Step& step, Balance& balance,
                      const NewtonOptions& options) {
  constexpr double sufficient = 1e-4, shortest = 0.01;
  constexpr double least_cut = 0.1, most_cut = 0.5;
  const double start = merit_.value(balance), rounding = CondensedEnergy::rounding(balance);
  const bool down = step.slope < 0;
  const bool too_stiff = indefinite_ && balance.residual.norm() < kFarFromBalance * balance.flow;
  for (double fraction = 1; fraction > shortest;) {
    const auto lowers = [&](const Trial& trial) {
      if (!std::isfinite(trial.merit)) return false;
      if (!down) return true;
      return trial.merit <= start + sufficient * fraction * step.slope + rounding;
    };
    Trial trial = tried(state, step, balance, fraction, lowers);
    const bool lower = lowers(trial);
    if (lower || settles(trial, state, balance, sufficient * fraction, options)) {
      if (fraction == 1 && down && lower && too_stiff)
        fraction = lengthened(trial, state, step, balance);
      if (options.watch && down && lower) options.watch(start, trial.merit);
      state = std::move(trial.state);
      balance = std::move(trial.balance);
      return fraction;
    }
    const double rise = trial.merit - start - step.slope * fraction;  // above the tangent
    const double least = std::isfinite(rise) ? -step.slope * fraction / (2 * rise) : 0;
    fraction *= std::clamp(least, least_cut, most_cut);
  }
  return 0;
}

NewtonReport Newton::solve(State& state, const NewtonOptions& options,
                           std::vector<HermiteMesh::Node> pending) {
  NewtonReport report = iterate(state, options, std::move(pending));
  if (options.following.end) options.following.end();
  return report;
}

NewtonReport Newton::iterate(State& state, const NewtonOptions& options,
                             std::vector<HermiteMesh::Node> pending) {
  NewtonReport report;
  Balance balance = assembler_.balance(state);
  following_ = held_ = false;
  const auto stop = [&](const char* reason) {
    return stopped(report, balance, options, pending.empty(), reason);
  };
  merit_.forget();  // no solve hangs on another
  shift_ = damping_ = 0;
  indefinite_ = true;  // not known of this state
  indefinite_for_ = 0;
  if (is_zero(pending)) pending.clear();
  Nearest nearest;
  int falls = 0;
  for (;; ++report.iterations) {
    bool fresh = false;
    if (options.following && (following_ || balance.residual.norm() <= kFollow * balance.flow)) {
      following_ = true;
      fresh = refresh(state, balance, options);
    }
    report.residual = balance.flow > 0 ? balance.residual.norm() / balance.flow : 0;
    if (!std::isfinite(balance.energy)) {
      report.reason = "an element is inverted";
      return report;
    }
    if (fresh && pending.empty()) nearest.note(state, report.residual, report.iterations);
    bool good_enough = false;
    if (nearest.long_ago(report.iterations)) {
      state = nearest.state();
      options.following.refresh(state, 1);
      balance = assembler_.balance(state);
      report.residual = balance.residual.norm() / balance.flow;
      indefinite_ = true;  // not known of this state
      good_enough = acceptable(report, balance, options);
      if (!good_enough && held_) return stop("the iterations circle and come no nearer to balance");
      held_ = true;
      nearest.forget();
    }
    if (good_enough || (pending.empty() && balanced(balance, options))) {
      // The last matrix is that of the state before: where one on the way was not definite, this
      // state's own is asked.
      const bool minimum = (!indefinite_ && report.indefinite == 0) || options.keep_unstable ||
                           options.tolerance > options.stable_below || is_stable(state);
      nearest.forget();
      held_ = held_ || (following_ && falls > 0);  // it has led back to where it fell from
      if (!minimum && ++falls <= options.most_falls && fall(state, balance, options, report))
        continue;
      report.converged = minimum;
      if (!minimum) report.reason = "the equilibrium found is unstable";
      return report;
    }
    if (report.iterations == options.max_iterations)
      return stop("no equilibrium within the allowed iterations");
    if (!factor_definite(state, options, pending, report))
      return stop("the tangent stays indefinite under the largest shift");
    const Step step = solve_step(state, balance, pending);
    const State before = state;
    const double fraction = search(state, step, balance, options);
    if (following_ && options.following.step) options.following.step(before, state);
    if (fraction == 0 && shift_ >= options.max_shift / 4) return stop("no step lowers the energy");
    if (fraction == 0)
      damping_ = std::max(kFirstDamping, 8 * std::max(damping_, shift_));
    else if (report.residual < kNearBalance)
      adapt_damping(fraction);
    else
      damping_ = 0;
    for (auto& node : pending) node *= 1 - fraction;
    if (is_zero(pending)) pending.clear();
  }
}

}  // namespace mammotwin
