#include "solver/gravity/unload.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "solver/gravity/inverse_equilibrium.h"

namespace mammotwin {

namespace {

using Nodes = std::vector<HermiteMesh::Node>;

std::string percent(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

/// Strain from the unloaded to the prone shape at the quadrature points.
void measure_strain(const BreastProblem& hanging, const SolidOptions& solid, UnloadReport& report) {
  const BreastModel breast = make_breast_model(hanging, solid);
  std::vector<double> stretches;
  report.min_J = report.max_J = 1;
  for (int e = 0; e < breast.model->num_elements(); ++e)
    for (const auto& F : breast.model->element(e).deformation_gradients(
             breast.model->coefficients(hanging.prone, e))) {
      const Eigen::Matrix3d C = F.transpose() * F;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squares(C, Eigen::EigenvaluesOnly);
      stretches.push_back(std::sqrt(squares.eigenvalues()[2]));
      report.min_J = std::min(report.min_J, F.determinant());
      report.max_J = std::max(report.max_J, F.determinant());
    }
  std::sort(stretches.begin(), stretches.end());
  report.stretch_p95 = stretches[stretches.size() * 95 / 100];
  report.stretch_max = stretches.back();
}

/// One unloading under way.
class Unloading {
 public:
  Unloading(const BreastProblem& problem, const UnloadOptions& options, const Progress& progress)
      : problem_(problem),
        options_(options),
        progress_(progress),
        inverse_(problem, options.solid) {}
  UnloadResult run();

 private:
  struct TakenOff {
    State reference;
    LoadSteppingReport load;
    double margin = 0;  ///< 0 where the load is not complete
    DeadForces skin_forces;
    double skin_force_N = 0;
  };
  TakenOff take_off(double share);
  void take(TakenOff found, UnloadResult& result);
  HangOptions reload_options() const;
  struct Reload {
    std::optional<double> error_mm;  ///< empty where the breast does not come to rest
    std::string reason;
    bool back_within(double tolerance) const { return error_mm && *error_mm < tolerance; }
  };
  Reload reload(const Nodes& unloaded, double share, const DeadForces& skin_forces,
                const HangOptions& options) const;
  std::optional<double> naive_error() const;
  void find_largest_share(UnloadResult& result, bool reloaded);
  void check(UnloadResult& result);
  void say(double fraction, const std::string& what) const {
    if (progress_) progress_(fraction, what);
  }

  const BreastProblem& problem_;
  const UnloadOptions& options_;
  const Progress& progress_;
  InverseEquilibrium inverse_;
  DeadForces skin_forces_;  ///< of the result
};

/// Solves for a share of the gravity, from the prone shape on.
Unloading::TakenOff Unloading::take_off(double share) {
  const Eigen::Vector3d weight = share * problem_.density * problem_.gravity;
  TakenOff result{inverse_.start(), {}, 0, {}};
  result.load =
      inverse_.raise(result.reference, weight, problem_.pressed.way_mm, options_.load,
                     options_.tolerance, options_.max_iterations,
                     [&](const LoadSteppingReport& so_far, const State&, const NewtonReport&) {
                       say(0.5 * so_far.reached, "gravity taken off");
                     });
  if (result.load.complete()) result.margin = inverse_.stability_margin(result.reference);
  result.skin_forces = inverse_.skin_forces(result.reference);
  result.skin_force_N = inverse_.skin_force_N(result.reference);
  return result;
}

HangOptions Unloading::reload_options() const {
  HangOptions options;
  options.solid = options_.solid;
  options.tolerance = options_.tolerance;
  options.load.smallest_step = 1.0 / 16;  // a shape that hangs back does so in one to three steps
  options.load.max_iterations = 150;
  return options;
}

/// Where an unloaded shape hangs to, beside the prone one.
Unloading::Reload Unloading::reload(const Nodes& unloaded, double share,
                                    const DeadForces& skin_forces,
                                    const HangOptions& options) const {
  BreastProblem hanging = from_unloaded(problem_, unloaded);
  hanging.gravity *= share;
  hanging.skin_forces = skin_forces;
  const HangResult again = hang(hanging, options);
  if (!again.report.usable())
    return {std::nullopt, "it stops at " + percent(again.report.gravity_fraction) +
                              " of the gravity: " + again.report.reason};
  return {largest_distance(again.deformed, hanging.prone), "it comes to rest elsewhere"};
}

/// What many do: solve the prone shape with gravity reversed and call that unloaded.
std::optional<double> Unloading::naive_error() const {
  if (problem_.pressed) return std::nullopt;  // it reverses gravity, not what pressed
  BreastProblem reversed = problem_;
  reversed.prone.clear();
  reversed.gravity *= -1;
  HangOptions options = reload_options();
  // Soft tissue stood on its head buckles, and for long: only a comparison, it is not waited for.
  options.load.smallest_step = 1;
  options.step_iterations = 12;
  const HangResult naive = hang(reversed, options);
  if (!naive.report.usable()) return std::nullopt;
  return reload(naive.deformed, 1, {}, options).error_mm;
}

/// Bisection for the share of the gravity up to which the imaged shape is stable and, if
/// `reloaded`, the unloaded one hangs back to it.
void Unloading::find_largest_share(UnloadResult& result, bool reloaded) {
  constexpr int trials = 5;  // to a thirty-second
  UnloadReport& report = result.report;
  double low = 0, high = 1;
  TakenOff best{inverse_.start(), {}, 1, {}};
  for (int trial = 0; trial < trials; ++trial) {
    const double share = (low + high) / 2;
    say(0.5 + 0.08 * trial, "looking for the largest gravity that works");
    TakenOff tried = take_off(share);
    report.newton_iterations += tried.load.iterations;
    const bool works =
        tried.margin > 0 &&
        (!reloaded || reload(tried.reference.x, share, tried.skin_forces, reload_options())
                          .back_within(options_.round_trip_tolerance));
    (works ? low : high) = share;
    if (works) best = std::move(tried);
  }
  report.gravity_fraction = low;
  report.stability_margin = best.margin;
  take(std::move(best), result);
}

/// What pressed, for tissue so much stiffer that all of the gravity acts.
void Unloading::take(TakenOff found, UnloadResult& result) {
  result.unloaded = std::move(found.reference.x);
  result.pressure = std::move(found.reference.pressure);
  skin_forces_ = std::move(found.skin_forces);
  const double share = result.report.gravity_fraction;
  result.report.skin_force_N = share > 0 ? found.skin_force_N / share : 0;
}

/// Loads the result again. A stable shape that balances may yet be one of several.
void Unloading::check(UnloadResult& result) {
  UnloadReport& report = result.report;
  say(0.9, "loading again");
  const Reload again =
      reload(result.unloaded, report.gravity_fraction, skin_forces_, reload_options());
  if (again.back_within(options_.round_trip_tolerance)) {
    report.round_trip_max_mm = *again.error_mm;
    if (report.usable()) report.naive_reversal_error_mm = naive_error();
    return;
  }
  report.converged = false;
  report.reason =
      "the unloaded shape, loaded again, does not come to rest in the imaged one; " + again.reason;
  find_largest_share(result, true);
}

UnloadResult Unloading::run() {
  const auto begin = std::chrono::steady_clock::now();
  UnloadResult result;
  UnloadReport& report = result.report;
  TakenOff all = take_off(1);
  report.converged = all.margin > 0;
  report.gravity_fraction = all.load.reached;
  report.stability_margin = all.margin;
  report.steps = all.load.steps;
  report.cutbacks = all.load.cutbacks;
  report.newton_iterations = all.load.iterations;
  report.dof = inverse_.num_equations();
  take(std::move(all), result);
  if (!report.converged) {
    report.reason = all.load.complete() ? "the imaged shape is not stable under its weight: "
                                          "unloaded and loaded again, it would fall elsewhere"
                                        : all.load.reason;
    find_largest_share(result, false);
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const bool loaded = !problem_.gravity.isZero() && report.gravity_fraction > 0;
  if (options_.check && loaded) check(result);
  report.sag_max_mm = largest_distance(result.unloaded, problem_.mesh.mesh.nodes());
  measure_strain(from_unloaded(problem_, result.unloaded), options_.solid, report);
  say(1, "unloaded");
  return result;
}

}  // namespace

BreastProblem from_unloaded(const BreastProblem& prone, const Nodes& unloaded) {
  BreastProblem problem = prone;
  problem.prone = prone.mesh.mesh.nodes();
  problem.mesh.mesh = HermiteMesh(unloaded, prone.mesh.mesh.elements());
  return problem;
}

UnloadResult unload(const BreastProblem& problem, const UnloadOptions& options,
                    const Progress& progress) {
  return Unloading(problem, options, progress).run();
}

}  // namespace mammotwin
