#include "pipeline/steps/coil_release.h"

#include <algorithm>

#include "solver/gravity/inverse_equilibrium.h"

namespace mammotwin {
namespace {

constexpr double kFreeOfLoad = 0.8;  // as round as breasts are without load

constexpr double kQuiteFlat = 0.5;  // as imaged: let go altogether

/// The nearer a breast is to one that hangs, the less it was pressed: no breast is let go by more
/// than its neighbour for a hair.
double likely_roundness(double imaged) {
  const double flat = std::clamp((kFlat - imaged) / (kFlat - kQuiteFlat), 0.0, 1.0);
  return imaged + flat * (kFreeOfLoad - imaged);
}

}  // namespace

std::optional<CoilRelease> release_from_coil(const BreastProblem& imaged, const PressedSides& sides,
                                             std::optional<double> roundness,
                                             const Progress& progress) {
  const double wanted = roundness.value_or(likely_roundness(sides.roundness));
  if (sides.roundness >= wanted) return std::nullopt;
  BreastProblem problem = imaged;
  problem.pressed = pressed_skin(imaged.mesh, sides);
  const Roundness figure(imaged.mesh, sides.across);
  CoilRelease release{
      problem.pressed,
      fit_skin_way(
          problem, [&](const auto& shape) { return figure.of(shape); }, wanted, {}, progress)};
  if (release.fit.way_mm == 0) return std::nullopt;
  release.pressed.way_mm = release.fit.way_mm;
  return release;
}

UnloadResult unload_released(BreastProblem& problem, const PressedSides& sides,
                             std::optional<CoilRelease>& release, const Progress& progress) {
  UnloadOptions all_of_gravity;
  all_of_gravity.parts = false;
  const Roundness roundness(problem.mesh, sides.across);
  for (const double share : {1.0, 0.5, 0.25}) {
    problem.pressed = release->pressed;
    problem.pressed.way_mm *= share;
    UnloadResult result = unload(problem, all_of_gravity, progress);
    if (!result.report.usable()) continue;
    if (share < 1) {
      release->pressed = problem.pressed;
      release->fit.way_mm = problem.pressed.way_mm;
      release->fit.figure = roundness.of(result.unloaded);
      release->fit.reason = "it would not hang as imaged";
    }
    return result;
  }
  release.reset();
  problem.pressed = {};
  return unload(problem, {}, progress);
}

std::vector<HermiteMesh::Node> rounder_shape(const BreastProblem& released,
                                             const PressedSides& sides, const UnloadResult& found,
                                             double gravity_share, double by) {
  constexpr double nudge = 0.1;  // [mm]
  InverseEquilibrium inverse(released, {});
  inverse.set_skin_way(released.pressed.way_mm);
  const State solution{found.unloaded, found.pressure};
  inverse.linearise_at(solution, gravity_share * released.density * released.gravity);
  const std::vector<HermiteMesh::Node> slope = inverse.change_by_skin_way(solution);
  const Roundness roundness(released.mesh, sides.across);
  const double rounder_by_mm = (roundness.of(combined(1, found.unloaded, nudge, slope)) -
                                roundness.of(combined(1, found.unloaded, -nudge, slope))) /
                               (2 * nudge);
  return combined(1, found.unloaded, by / rounder_by_mm, slope);
}

}  // namespace mammotwin
