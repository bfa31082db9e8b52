#include "fitting/solve/fit_stages.h"

#include <algorithm>
#include <utility>

#include "fitting/mesh/jacobian_bound.h"

namespace mammotwin {

namespace {

// Elements below these get emphasis.
constexpr double wanted_scaled_jacobian = 0.15;
constexpr double wanted_determinant = 0.03;  // of the mean
// A step of length r in the trust region's measure changes the model's cost by about r², and costs
// are of order 1: the first region holds every step that is wanted, the last one none that counts.
constexpr double first_radius = 4;
constexpr double regrown = 4;  // times the radius where a call of Ceres ended, for the next one
constexpr double least_regrown = 0.32;  // so four halvings at least are tried before it ends
// So many halvings of the trust region before one step: elements about to fold hold the mesh.
// Emphasis helps then; a third time costs the worst breast as many iterations again (44, then 88)
// for 0.08 mm of its 95 %.
constexpr int refusals_when_stuck = 3, stuck_emphasis = 2;

}  // namespace

/// Notes every iteration, and ends a stage.
class StagedFit::Watch : public ceres::IterationCallback {
 public:
  Watch(StagedFit& fit, const FitStage& stage) : fit_(fit), stage_(stage) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& i) override {
    note(i);
    if (i.iteration == 0) return ceres::SOLVER_CONTINUE;
    --fit_.iterations_left_;
    if (!i.step_is_successful) {
      ++refusals_;
      return ceres::SOLVER_CONTINUE;
    }
    ++steps_;
    const bool stuck = std::exchange(refusals_, 0) >= refusals_when_stuck;
    if (stage_.demand == MeshDemand::proved_in_shape)
      fit_.point_.demand(stage_.demand, fit_.mesh());
    emphasised_ = stuck && stage_.demand == MeshDemand::proved && !stage_.steep &&
                  fit_.emphasise_poor(stuck_emphasis);
    const bool done =
        emphasised_ || steps_ == stage_.max_steps || (stage_.until_proved && fit_.proved());
    return done ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

  int steps() const { return steps_; }
  bool emphasised() const { return emphasised_; }

 private:
  void note(const ceres::IterationSummary& i) {
    FitReport& report = fit_.report_;
    StepOutcome outcome = StepOutcome::accepted;
    if (i.iteration == 0 || i.step_is_successful)
      cost_ = i.cost, skin_rms_mm_ = fit_.point_.skin_rms_mm();
    else
      outcome =
          fit_.point_.refused() ? StepOutcome::refused_by_proof : StepOutcome::refused_by_cost;
    report.course.push_back({stage_.name, outcome, cost_, skin_rms_mm_, i.trust_region_radius});
    if (i.iteration == 0) return;
    ++report.iterations;
    if (fit_.progress_)
      fit_.progress_(std::min(0.9, 0.2 + 0.02 * report.iterations), "fitting the mesh");
  }

  StagedFit& fit_;
  const FitStage& stage_;
  int steps_ = 0, refusals_ = 0;
  bool emphasised_ = false;
  double cost_ = 0, skin_rms_mm_ = 0;
};

StagedFit::StagedFit(const Slab& slab, HermiteMesh start, FitTarget& target, int max_iterations,
                     FitReport& report, const FitProgress& progress)
    : start_(std::move(start)),
      nodes_(start_.nodes()),
      target_(target),
      point_(slab, start_, target),
      problem_(point_, start_.elements(), held_parameters(slab), nodes_),
      iterations_left_(max_iterations),
      radius_(first_radius),
      report_(report),
      progress_(progress) {}

bool StagedFit::proved() const { return proved_valid(mesh()); }

void StagedFit::restart() {
  nodes_ = start_.nodes();
  forget_emphasis();
  target_.forget_feet();
  radius_ = first_radius;
}

ceres::Solver::Options StagedFit::options(const FitStage& stage) const {
  ceres::Solver::Options options = FitProblem::options();
  options.initial_trust_region_radius = radius_;
  options.min_trust_region_radius = stage.last_radius;
  options.function_tolerance = stage.least_gain;
  options.max_num_iterations = iterations_left_;
  return options;
}

void StagedFit::run(const FitStage& stage) {
  target_.weigh_mesh(mesh());
  point_.set_weights({.all = stage.data_weight});
  point_.model().weigh(stage.shape_weight, stage.smoothing);
  point_.model().shape_energy().steepen(stage.steep);
  point_.model().shape_energy().take_gauss_newton(stage.gauss_newton);
  point_.model().tether(stage.tether, nodes_);
  for (FitStage rest = stage; rest.max_steps > 0 && iterations_left_ > 0;) {
    point_.demand(stage.demand, mesh());
    Watch watch(*this, rest);
    ceres::Solver::Options options = this->options(rest);
    options.callbacks = {&watch};
    const ceres::Solver::Summary summary = problem_.solve(options);
    report_.solver_reports.push_back(stage.name + "\n" + summary.FullReport());
    radius_ = std::clamp(regrown * summary.iterations.back().trust_region_radius, least_regrown,
                         first_radius);
    const bool stuck = summary.iterations.back().trust_region_radius <= stage.last_radius;
    if (!watch.emphasised() && !(stuck && !stage.steep && stage.demand == MeshDemand::proved &&
                                 emphasise_poor(stuck_emphasis)))
      break;
    rest.max_steps -= watch.steps();
  }
}

bool StagedFit::emphasise_poor(int most) {
  const std::vector<JacobianBound> bounds = bound_elements(mesh());
  const std::vector<double> scaled = scaled_jacobians(mesh());
  bool any = false;
  for (int e = 0; e < start_.num_elements(); ++e)
    if (bounds[e].lower < wanted_determinant || scaled[e] < wanted_scaled_jacobian) {
      ShapeEnergy& energy = point_.model().shape_energy();
      if (energy.emphasis(e) >= most) continue;
      energy.emphasise(e);
      any = true;
    }
  return any;
}

}  // namespace mammotwin
