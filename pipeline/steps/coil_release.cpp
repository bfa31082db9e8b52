#include "pipeline/steps/coil_release.h"

namespace mammotwin {

std::optional<CoilRelease> release_from_coil(const BreastProblem& imaged, const PressedSides& sides,
                                             double roundness, const Progress& progress) {
  if (sides.roundness >= roundness) return std::nullopt;
  BreastProblem problem = imaged;
  problem.pressed = pressed_skin(imaged.mesh, sides);
  const Roundness figure(imaged.mesh, sides.across);
  CoilRelease release{
      problem.pressed,
      fit_skin_way(
          problem, [&](const auto& shape) { return figure.of(shape); }, roundness, {}, progress)};
  if (release.fit.way_mm == 0) return std::nullopt;
  release.pressed.way_mm = release.fit.way_mm;
  return release;
}

std::vector<HermiteMesh::Node> rounder_shape(const BreastProblem& imaged, const PressedSides& sides,
                                             const CoilRelease& release, double by) {
  const auto rounder = release_from_coil(imaged, sides, release.fit.figure + by);
  if (!rounder || !rounder->fit.reason.empty()) return {};
  BreastProblem problem = imaged;
  problem.pressed = rounder->pressed;
  UnloadOptions options;
  options.check = false;
  const UnloadResult result = unload(problem, options);
  return result.report.usable() ? result.unloaded : std::vector<HermiteMesh::Node>();
}

}  // namespace mammotwin
