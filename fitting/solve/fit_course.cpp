#include "fitting/solve/fit_course.h"

#include <algorithm>
#include <optional>

#include "fitting/mesh/jacobian_bound.h"
#include "fitting/solve/newton_step.h"

namespace mammotwin {

namespace {

// Elements below these get emphasis.
constexpr double wanted_scaled_jacobian = 0.15;
// In the end elements that have this keep it, and others lose a tenth of theirs a step at most.
constexpr double needed_scaled_jacobian = 0.1;
constexpr double kept_part = 0.9;
constexpr double wanted_determinant = 0.03;  // of the mean
// Columns at the nipple are this much denser plus one than elsewhere, over this part of the skin.
constexpr double grading_strength = 1;
constexpr double grading_width = 0.12;

/// Weights of one part of the fit, and when it ends.
struct Stage {
  double data, mu, sobolev;
  int steps;
  enum class Validity { any, until_proved, stays_proved, stays_shaped } validity;
  double least_gain = 3e-4;  // of the cost, of which a part is energy that no fit can lose
};
using enum Stage::Validity;

/// Of every element's scaled Jacobian.
bool keeps_shape(const std::vector<double>& before, const std::vector<double>& after) {
  return std::equal(after.begin(), after.end(), before.begin(), [](double now, double then) {
    return now >= (then < needed_scaled_jacobian ? kept_part * then : needed_scaled_jacobian);
  });
}

/// The fit as it goes.
class Fit {
 public:
  Fit(const Slab& slab, HermiteMesh start, FitTarget& target, FitReport& report,
      const FitProgress& progress)
      : slab_(slab),
        start_(std::move(start)),
        nodes_(start_.nodes()),
        emphasis_(start_.num_elements(), 0),
        target_(target),
        newton_(start_.elements(), held_parameters(slab)),
        report_(report),
        progress_(progress) {}

  HermiteMesh mesh() const { return HermiteMesh(nodes_, start_.elements()); }

  void restart() {
    nodes_ = start_.nodes();
    emphasis_.assign(emphasis_.size(), 0);
    target_.forget_feet();
  }

  /// Newton steps, closest points renewed before each, until they gain little. A proved mesh whose
  /// steps are cut short by elements about to fold is stuck: these get emphasis.
  void run(const Stage& stage) {
    std::optional<FitModel> model;
    for (int step = 0; step < stage.steps; ++step) {
      if (!model) model.emplace(slab_, start_, stage.mu, stage.sobolev, emphasis_);
      const StepReport done = renew_and_step(*model, stage);
      if (stage.validity == until_proved && proved_valid(mesh())) break;
      if (stage.validity >= stays_proved && done.length < stuck_length && emphasise_poor()) {
        model.reset();
        continue;
      }
      if (done.cost_before - done.cost_after < stage.least_gain * done.cost_before) break;
    }
  }

  /// Gives more weight to elements that are badly shaped or near folding; false if there are none.
  bool emphasise_poor() {
    const std::vector<JacobianBound> bounds = bound_elements(mesh());
    const std::vector<double> scaled = scaled_jacobians(mesh());
    bool any = false;
    for (std::size_t e = 0; e < scaled.size(); ++e)
      if (bounds[e].lower < wanted_determinant || scaled[e] < wanted_scaled_jacobian)
        ++emphasis_[e], any = true;
    return any;
  }

 private:
  StepReport renew_and_step(FitModel& model, const Stage& stage) {
    model.update(nodes_, target_.samples(mesh(), {stage.data}));
    report_.skin_rms_by_iteration_mm.push_back(target_.skin_rms());
    const StepReport done = newton_.step(model, nodes_, acceptable(stage.validity));
    ++report_.iterations;
    if (progress_) progress_(std::min(0.9, 0.2 + 0.03 * report_.iterations), "fitting the mesh");
    return done;
  }

  /// A proved mesh stays so; in the end elements also keep the shape that they need.
  NewtonStep::Acceptable acceptable(Stage::Validity validity) const {
    if (validity == stays_proved) return proved_valid;
    if (validity != stays_shaped) return {};
    return [before = scaled_jacobians(mesh())](const HermiteMesh& trial) {
      return keeps_shape(before, scaled_jacobians(trial)) && proved_valid(trial);
    };
  }

  static constexpr double stuck_length = 0.2;  // of a full step

  Slab slab_;
  HermiteMesh start_;
  std::vector<HermiteMesh::Node> nodes_;
  std::vector<int> emphasis_;
  FitTarget& target_;
  NewtonStep newton_;
  FitReport& report_;
  const FitProgress& progress_;
};

/// From the start to a mesh that is proved valid. Where the data folds it, the data waits.
bool untangle(Fit& fit) {
  constexpr double mu = 10, rough = 0.01;
  // Of 10 breasts looked at 7 were valid after 3 steps, the others not after 6 either.
  fit.run({1, mu, 1e-6, 3, any});
  if (proved_valid(fit.mesh())) fit.run({1, mu, 1e-6, 3, any});
  if (proved_valid(fit.mesh())) return true;
  for (double sobolev : {1e-6, 1e-5, 1e-4}) {
    fit.restart();
    fit.run({0.02, mu, sobolev, 8, until_proved});
    if (!proved_valid(fit.mesh())) continue;
    fit.run({0.1, mu, 1e-6, 4, stays_proved, rough});
    fit.emphasise_poor();
    fit.run({1, mu, 1e-6, 4, stays_proved, rough});
    return true;
  }
  return false;
}

}  // namespace

Slab slab_around_nipple(const Eigen::Vector3i& elements, const FitGoal& goal) {
  const auto nearer = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - goal.nipple_in_lps).squaredNorm() < (b - goal.nipple_in_lps).squaredNorm();
  };
  const auto& skin = goal.skin.vertices;
  const Eigen::Vector2d nipple =
      goal.flat.uv[std::min_element(skin.begin(), skin.end(), nearer) - skin.begin()];
  Slab slab{elements};
  for (int a = 0; a < 2; ++a)
    slab.grading[a] =
        Grading(std::clamp(nipple[a], 0.05, 0.95), grading_strength, grading_width, elements[a]);
  return slab;
}

FitCourse fit_slab(const Slab& slab, const FitGoal& goal, double shape, double smoothing,
                   FitReport& report, const FitProgress& progress) {
  FitTarget target(slab, goal.skin, goal.flat, goal.wall, goal.nipple_in_lps);
  Fit fit(slab, straight_start(slab, goal.skin, goal.flat, goal.wall, goal.region), target, report,
          progress);
  if (!untangle(fit)) return {fit.mesh(), false};
  fit.emphasise_poor();
  fit.run({1, shape, smoothing, 5, stays_proved});
  for (int round = 0; round < 3 && fit.emphasise_poor(); ++round)
    fit.run({1, shape, smoothing, 2, stays_shaped});
  return {fit.mesh(), true};
}

}  // namespace mammotwin
