#include "solver/gravity/unload.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
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
  struct Rest {  ///< of a shape that was loaded again, against the imaged one
    bool found = false;
    double max_mm = 0, rms_mm = 0;
    std::string reason;  ///< why it is none, or not the imaged one
  };
  struct TakenOff {
    State reference;
    LoadSteppingReport load;
    double margin = 0;  ///< 0 where the load is not complete
    DeadForces skin_forces;
    double skin_force_N = 0;
    Rest rest{};  ///< where it was asked for
  };
  TakenOff take_off(double share);
  void take(TakenOff found, UnloadResult& result);
  HangOptions reload_options() const;
  Rest reload(const Nodes& unloaded, double share, const DeadForces& skin_forces,
              const HangOptions& options) const;
  bool rests_as_imaged(TakenOff& tried, double share) const;
  std::optional<double> naive_error() const;
  void find_largest_share(UnloadResult& result);
  void say(double fraction, const std::string& what) const {
    if (progress_) progress_(fraction, what);
  }

  const BreastProblem& problem_;
  const UnloadOptions& options_;
  const Progress& progress_;
  InverseEquilibrium inverse_;
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

Unloading::Rest Unloading::reload(const Nodes& unloaded, double share,
                                  const DeadForces& skin_forces, const HangOptions& options) const {
  BreastProblem hanging = from_unloaded(problem_, unloaded);
  hanging.gravity *= share;
  hanging.skin_forces = skin_forces;
  const HangResult again = hang(hanging, options);
  if (!again.report.usable())
    return {false, 0, 0,
            "it stops at " + percent(again.report.gravity_fraction) +
                " of the gravity: " + again.report.reason};
  return {true, largest_distance(again.deformed, hanging.prone),
          rms_distance(again.deformed, hanging.prone), ""};
}

/// A stable shape that balances may yet be one of several, and one that is not stable may lie
/// beside one that is: the breast is loaded again, unless the shape is stable and nobody asks.
bool Unloading::rests_as_imaged(TakenOff& tried, double share) const {
  Rest& rest = tried.rest;
  if (!tried.load.complete()) {
    rest.reason = tried.load.reason;
    return false;
  }
  const bool stable = tried.margin > 0;
  if (stable && (!options_.check || problem_.gravity.isZero())) return true;
  rest = reload(tried.reference.x, share, tried.skin_forces, reload_options());
  if (rest.found && rest.rms_mm <= options_.rest_tolerance) return true;
  rest.reason = "the unloaded shape, loaded again, does not come to rest in the imaged one; " +
                (rest.found ? "it comes to rest elsewhere" : rest.reason);
  return false;
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
  const Rest rest = reload(naive.deformed, 1, {}, options);
  return rest.found ? std::optional(rest.max_mm) : std::nullopt;
}

/// Bisection for the share of the gravity up to which the breast rests where it was imaged.
void Unloading::find_largest_share(UnloadResult& result) {
  constexpr int trials = 5;  // to a thirty-second
  UnloadReport& report = result.report;
  double low = 0, high = 1;
  TakenOff best{inverse_.start(), {}, 1, {}};
  for (int trial = 0; trial < trials; ++trial) {
    const double share = (low + high) / 2;
    say(0.5 + 0.08 * trial, "looking for the largest gravity that works");
    TakenOff tried = take_off(share);
    report.newton_iterations += tried.load.iterations;
    const bool works = rests_as_imaged(tried, share);
    (works ? low : high) = share;
    if (works) best = std::move(tried);
  }
  report.gravity_fraction = low;
  take(std::move(best), result);
}

void Unloading::take(TakenOff found, UnloadResult& result) {
  UnloadReport& report = result.report;
  report.stability_margin = found.margin;
  report.round_trip_max_mm = found.rest.max_mm;
  report.round_trip_rms_mm = found.rest.rms_mm;
  // For tissue so much stiffer that all of the gravity acts.
  const double share = report.gravity_fraction;
  report.skin_force_N = share > 0 ? found.skin_force_N / share : 0;
  result.unloaded = std::move(found.reference.x);
  result.pressure = std::move(found.reference.pressure);
}

UnloadResult Unloading::run() {
  UnloadResult result;
  UnloadReport& report = result.report;
  TakenOff all = take_off(1);
  report.steps = all.load.steps;
  report.cutbacks = all.load.cutbacks;
  report.newton_iterations = all.load.iterations;
  report.dof = inverse_.num_equations();
  say(0.5, "loading again");
  report.converged = rests_as_imaged(all, 1);
  if (report.converged) {
    report.gravity_fraction = 1;
    take(std::move(all), result);
  } else {
    report.reason = all.rest.reason;
    if (!options_.parts) return result;
    find_largest_share(result);
  }
  if (options_.check && report.usable() && !problem_.gravity.isZero()) {
    say(0.9, "reversing gravity, to compare");
    report.naive_reversal_error_mm = naive_error();
  }
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
