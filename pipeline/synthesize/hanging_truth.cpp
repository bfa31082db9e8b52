#include "pipeline/synthesize/hanging_truth.h"

#include <stdexcept>

#include "fitting/fit_breast.h"
#include "pipeline/patient/gravity_settings.h"
#include "pipeline/steps/breast_problem.h"
#include "pipeline/synthesize/mean_fractions.h"
#include "solver/gravity/unload.h"

namespace mammotwin {
namespace {

BreastProblem hanging_problem(MeshFile mesh, TissueSampler tissue) {
  BreastProblem problem = breast_problem(std::move(mesh), std::move(tissue), {}, 1);
  problem.boundary.wall_smoothing = 0;  // the wall is drawn, not traced: it has no voxels' hollows
  problem.gravity = gravity_in_lps(Pose::prone);
  problem.density = GravitySettings().density();
  return problem;
}

Segmentation truth_of(const SyntheticPatient& p) {
  return true_segmentation(p.tissue, p.labels, p.truth);
}

}  // namespace

void with_true_breast(const SyntheticPatient& patient, const MeshFile& mesh,
                      const std::function<void(const BreastProblem&)>& use) {
  const Segmentation truth = truth_of(patient);
  // Cubes round the points and not the mesh's cells: what the sample's truth was made with.
  const MeanFractions mean(truth.fractions);
  use(hanging_problem(mesh, [&mean](const Eigen::Vector3d& x_prone, double volume_mm3) {
    const Fractions f = mean.at(x_prone, volume_mm3);
    return std::array<double, 3>{f.fat, f.fibroglandular, f.lesion};
  }));
}

MeshFile hanging_truth(const SyntheticPatient& patient,
                       const std::function<void(double, const std::string&)>& progress) {
  FitOptions options;
  options.elements = kTruthElements;
  const FitResult fit = fit_breast(truth_of(patient), options, progress);
  if (!fit.report.usable())
    throw std::runtime_error("no mesh of the true breast: " + fit.report.reasons.front());
  MeshFile file = fit.mesh;
  with_true_breast(patient, fit.mesh, [&](const BreastProblem& problem) {
    const UnloadResult result = unload(problem, {}, progress);
    if (!result.report.usable())
      throw std::runtime_error("the true breast cannot hang as it was made: " +
                               result.report.reason);
    file.configurations["prone"] = fit.mesh.mesh.nodes();
    file.mesh = HermiteMesh(result.unloaded, fit.mesh.mesh.elements());
  });
  return file;
}

}  // namespace mammotwin
