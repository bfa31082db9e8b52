#include "fitting/solve/fit_mesh.h"

#include <algorithm>

#include "fitting/mesh/jacobian_bound.h"
#include "fitting/solve/fit_stages.h"
#include "fitting/surface/closest_point.h"

namespace mammotwin {

namespace {

// Columns at the nipple are this much denser plus one than elsewhere, over this part of the skin.
constexpr double grading_strength = 1;
constexpr double grading_width = 0.12;

constexpr double stiff = 10;      // shape weight that straightens what the data folds
constexpr int most_emphasis = 4;  // beyond 4⁴ times its energy an element outweighs the skin
// A fit that stops early ends where rounding takes it: with 20 steps, a gain of 3e-4 and no tether,
// nodes of 042 ended up to 18 mm apart for skins 0.4 um apart.
constexpr double converged = 1e-5;  // gain of a step, of the cost
constexpr int most_steps = 60;
constexpr double tether = 0.005;  // [mm²] a mm² of skin, beside 1 and 0.5 for distances to it
constexpr double untangling_gain = 0.01;  // of the cost: the mesh need only be valid there

/// Are there elements that the solver would not like? Mending them costs distance to the skin.
bool lacks_shape(const HermiteMesh& mesh) {
  const std::vector<double> scaled = scaled_jacobians(mesh);
  return *std::min_element(scaled.begin(), scaled.end()) < needed_scaled_jacobian;
}

/// From the start to a mesh that is proved valid. Where the data folds it, the data waits.
bool untangle(StagedFit& fit) {
  // Of 29 breasts looked at 21 were valid after 3 steps.
  const FitStage approach{.name = "approach", .shape_weight = stiff, .max_steps = 3};
  fit.run(approach);
  if (fit.proved())
    fit.run({.name = "approach",
             .shape_weight = stiff,
             .max_steps = most_steps,
             .least_gain = converged});
  if (fit.proved()) return true;
  for (double smoothing : {1e-6, 1e-5, 1e-4}) {
    fit.restart();
    fit.run({.name = "untangle with little data",
             .data_weight = 0.02,
             .shape_weight = stiff,
             .gauss_newton = true,
             .smoothing = smoothing,
             .until_proved = true});
    if (!fit.proved()) continue;
    fit.run({.name = "a tenth of the data",
             .data_weight = 0.1,
             .shape_weight = stiff,
             .gauss_newton = true,
             .max_steps = 4,
             .demand = MeshDemand::proved,
             .least_gain = untangling_gain});
    fit.emphasise_poor(most_emphasis);
    fit.run({.name = "all data",
             .shape_weight = stiff,
             .gauss_newton = true,
             .max_steps = 4,
             .demand = MeshDemand::proved,
             .least_gain = untangling_gain});
    return true;
  }
  return false;
}

/// Where the skin's point nearest to a place lies on the square.
Eigen::Vector2d flattened(const Eigen::Vector3d& place, const FitGoal& goal) {
  const ClosestPoint::Hit hit = ClosestPoint(goal.skin)(place);
  const auto& t = goal.skin.triangles[hit.triangle];
  const auto& x = goal.skin.vertices;
  const auto share = [&](int a, int b) {  // twice the signed area of a, b and the point
    return (x[t[a]] - hit.x).cross(x[t[b]] - hit.x).dot(hit.normal);
  };
  const Eigen::Vector3d shares(share(1, 2), share(2, 0), share(0, 1));
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  for (int corner = 0; corner < 3; ++corner)
    uv += shares[corner] / shares.sum() * goal.flat.uv[t[corner]];
  return uv;
}

}  // namespace

Slab slab_around_nipple(const Eigen::Vector3i& elements, const FitGoal& goal) {
  const Eigen::Vector2d nipple = flattened(goal.nipple_in_lps, goal);
  Slab slab{elements};
  for (int a = 0; a < 2; ++a)
    slab.grading[a] =
        Grading(std::clamp(nipple[a], 0.05, 0.95), grading_strength, grading_width, elements[a]);
  return slab;
}

FittedMesh fit_mesh(const Slab& slab, const FitGoal& goal, const FitOptions& options,
                    FitReport& report, const FitProgress& progress) {
  FitTarget target(slab, goal.skin, goal.flat, goal.wall, goal.nipple_in_lps);
  StagedFit fit(slab, straight_start(slab, goal.skin, goal.flat, goal.wall, goal.region), target,
                options.max_iterations, report, progress);
  if (!untangle(fit)) return {fit.mesh(), false};
  fit.forget_emphasis();
  const FitStage follow{.name = "follow the skin",
                        .shape_weight = options.shape,
                        .steep = true,
                        .smoothing = report.smoothing,
                        .tether = tether,
                        .max_steps = most_steps,
                        .demand = MeshDemand::proved,
                        .least_gain = converged,
                        .last_radius = 1e-3};
  // Twice: the tether of a second run is to a mesh nearer to the data, and holds it back less.
  for (int run = 0; run < 2; ++run) fit.run(follow);
  constexpr int repairs = 3;
  for (int repair = 0; repair < repairs && lacks_shape(fit.mesh()); ++repair) {
    fit.emphasise_poor(most_emphasis);
    FitStage mend = follow;
    mend.name = "mend poor elements";
    mend.max_steps = 2;
    mend.demand = MeshDemand::proved_in_shape;
    fit.run(mend);
  }
  return {fit.mesh(), true};
}

}  // namespace mammotwin
