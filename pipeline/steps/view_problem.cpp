#include "pipeline/steps/view_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/steps/breast_problem.h"
#include "pipeline/steps/solution_record.h"
#include "pipeline/steps/typical_thickness.h"
#include "registration/view/compressed_view.h"
#include "solver/contact/plate_placement.h"

namespace mammotwin {
namespace {

std::shared_ptr<const PlateMesh> facets(const std::filesystem::path& stl) {
  return std::make_shared<PlateMesh>(PlateMesh::read(stl));
}

/// The mesh as `compress` read it, from what it wrote.
MeshFile reference_of(const MeshFile& compressed) {
  MeshFile reference = compressed;
  const auto unloaded = compressed.configurations.find("unloaded");
  const bool was_unloaded = unloaded != compressed.configurations.end();
  reference.mesh =
      HermiteMesh(was_unloaded ? unloaded->second : compressed.configurations.at("prone"),
                  compressed.mesh.elements());
  if (!was_unloaded) reference.configurations.erase("prone");
  return reference;
}

/// The problem with the mechanical numbers of a state put in.
CompressionProblem changed(const Patient& patient, const ViewSettings& view, Side side,
                           const MeshFile& mesh, const TissueSampler& tissue, double thickness_mm,
                           const ViewState& state) {
  CompressionProblem problem = view_problem(
      patient, view, axes_of(side, view.angle() + state[kRoll], view.turn_deg.value_or(0)), mesh,
      tissue);
  CompressionSettings stiffer = patient.compression;
  for (LawSettings* law : {&stiffer.fibroglandular, &stiffer.lesion}) {
    law->c1_kpa *= std::exp(state[kStiffnessRatio]);
    law->c2_kpa *= std::exp(state[kStiffnessRatio]);
  }
  if (const auto rounder = mesh.configurations.find(kRounderByCoil);
      rounder != mesh.configurations.end() && state[kCoilRoundness] != 0) {
    const double share = state[kCoilRoundness] / kCoilRoundnessSd;
    problem.mesh.mesh =
        HermiteMesh(combined(1 - share, problem.mesh.mesh.nodes(), share, rounder->second),
                    problem.mesh.mesh.elements());
  }
  problem.laws = stiffer.laws(stiffness_factor_of(mesh, patient.compression));
  problem.boundary.chest_wall_spring *= std::exp(state[kSprings]);
  problem.friction.coefficient =
      std::clamp(problem.friction.coefficient + state[kFriction], 0.0, 1.0);
  problem.plates.thickness = thickness_mm + state[kThickness];
  problem.most_force = std::numeric_limits<double>::infinity();
  problem.plates.lift += state[kLift];
  problem.plates.wall_clearance = std::max(0.0, problem.plates.wall_clearance + state[kClearance]);
  problem.plates.paddle_tilt += state[kTilt];
  return problem;
}

/// What holds the breast drawn forward [mN/mm³]: so many times its weight, or what a hand draws
/// with.
double pull_on(const MeshFile& mesh, const PlateOptions& plates, const Patient& patient) {
  constexpr double kMilliNewton = 1e-3;
  const double weight = patient.gravity.density() * gravity_in_lps(Pose::prone).norm();
  const double in_front_N =
      kMilliNewton * weight * PlateFrame(prone_file(mesh), plates).volume_in_front();
  const CompressionSettings& settings = patient.compression;
  return weight * std::min(settings.pull, settings.most_pull_n / in_front_N);
}

}  // namespace

PlateOptions plates_of(const Patient& patient, const ViewSettings& view,
                       const Eigen::Matrix3d& axes, const MeshFile& mesh) {
  PlateOptions plates;
  plates.depth = axes.row(0);
  plates.up = axes.row(2);
  plates.lift = view.lift_mm;
  const CompressionSettings& settings = patient.compression;
  settings.shape_plates(plates);
  if (settings.support_stl) plates.support_mesh = facets(patient.resolve(*settings.support_stl));
  if (settings.paddle_stl) plates.paddle_mesh = facets(patient.resolve(*settings.paddle_stl));
  plates.thickness = view.thickness_mm ? *view.thickness_mm : assumed_thickness_mm(mesh, plates);
  return plates;
}

CompressionProblem view_problem(const Patient& patient, const ViewSettings& view,
                                const Eigen::Matrix3d& axes, const MeshFile& mesh,
                                const TissueSampler& tissue) {
  CompressionProblem problem{breast_problem(mesh, tissue, patient.compression,
                                            stiffness_factor_of(mesh, patient.compression)),
                             {},
                             {}};
  problem.friction = patient.compression.friction;
  problem.plates = plates_of(patient, view, axes, prone_file(mesh));
  if (!view.thickness_mm) problem.most_force = patient.compression.most_force_n;
  if (patient.compression.standing_gravity) {
    problem.gravity = gravity_in_lps(Pose::standing);
    problem.density = patient.gravity.density();
  }
  if (patient.compression.pull > 0 && mesh.configurations.contains("prone"))
    problem.pull = pull_on(mesh, problem.plates, patient) * problem.plates.depth;
  return problem;
}

void remember_solution(const CompressionResult& result, MeshFile& file) {
  write_solution({result.pressure, result.plates.support_height, result.plates.paddle_height,
                  result.plates.edge, result.plates.lateral_middle, result.penalty,
                  result.report.target_thickness_mm, result.report.drawn_times, result.holds},
                 file);
}

std::optional<NearbySolver> nearby_solver(const Patient& patient, const CompressedView& view,
                                          const MeshFile& compressed, const TissueSampler& tissue) {
  const auto solution = read_solution(compressed, view.name + ".vtu");
  if (!solution) return std::nullopt;
  SolvedView base{{}, view};
  CompressionResult& result = base.result;
  result.deformed = compressed.mesh.nodes();
  result.pressure = solution->pressure_kpa;
  result.plates.support_height = solution->support_height_mm;
  result.plates.paddle_height = solution->paddle_height_mm;
  result.plates.edge = solution->edge_mm;
  result.plates.lateral_middle = solution->lateral_middle_mm;
  result.penalty = solution->penalty_kpa_per_mm;
  result.holds = solution->holds;
  result.report.target_thickness_mm = solution->target_thickness_mm;
  result.report.thickness_mm = view.thickness_mm;
  ViewSettings settings = patient.view(view.name);
  settings.angle_deg = view.angle_deg;
  settings.turn_deg = view.turn_deg;
  return NearbySolver(base, [&patient, tissue, settings, side = view.side,
                             mesh = reference_of(compressed),
                             thickness = solution->target_thickness_mm,
                             drawn_times = solution->drawn_times](const ViewState& state) {
    CompressionProblem problem = changed(patient, settings, side, mesh, tissue, thickness, state);
    problem.pull *= drawn_times;
    return problem;
  });
}

}  // namespace mammotwin
