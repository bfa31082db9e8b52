// unload: the breast as imaged -> its shape free of stress, and how that hangs in other poses.

#include "solver/gravity/unload.h"

#include <algorithm>
#include <fstream>

#include "pipeline/frame/sidecar.h"
#include "pipeline/frame/stage.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/breast_problem.h"
#include "pipeline/steps/second_state.h"
#include "pipeline/steps/unload_quality.h"
#include "registration/search/view_state.h"
#include "segmentation/files/detached_data.h"
#include "segmentation/segmentation_file.h"
#include "solver/newton/blas_kernels.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path segmentation, fractions, mesh, unloaded;
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.input("segmentation", args.segmentation, "tissue labels from segment (.seg.nrrd)");
  stage.input("fractions", args.fractions, "tissue fractions from segment (.nrrd)");
  stage.input("mesh", args.mesh, "Hermite mesh from fit (.vtu)");
  stage.product("unloaded", args.unloaded, "unloaded mesh to write (.vtu)");
  stage.options_from("unload.", true);
  for (const char* prefix : {"gravity", "materials.", "compress.chest_wall", "compress.cut_face"})
    stage.options_from(prefix, false);
}

StagePlan plan(const Arguments&, const Patient& patient) {
  StagePlan plan{{},
                 {"gravity", "unload.", "materials.", "compress.chest_wall", "compress.cut_face"}};
  if (const auto second = patient.second_state()) {
    plan.inputs.push_back(*second);
    if (const auto data = detached_data_file(*second)) plan.inputs.push_back(*data);
  }
  return plan;
}

/// As the sidecar of the segmentation has it from the image; empty where it is not known.
std::string patient_position(const std::filesystem::path& segmentation) {
  const auto sidecar = read_sidecar(segmentation).sidecar;
  const auto position = nlohmann::json::json_pointer("/quality/patient_position");
  return sidecar && sidecar->contains(position) && (*sidecar)[position].is_string()
             ? (*sidecar)[position].get<std::string>()
             : "";
}

/// Progress of a part of the stage.
Progress part_of(const StageRun& stage, double from, double share) {
  return [&stage, from, share](double done, const std::string& what) {
    stage.progress(from + share * done, what);
  };
}

/// One factor for all stiffnesses where a second state is there to ask; else the settings'.
double find_stiffness(const Patient& patient, StageRun& stage, const BreastProblem& as_set,
                      UnloadingRecord& record) {
  const double factor = patient.compression.stiffness_factor;
  const auto second = patient.second_state();
  if (!second || record.imaged == Pose::none) return factor;
  const SecondState state(*second, as_set.mesh);
  const Eigen::Vector3d gravity = gravity_in_lps(patient.gravity.second_gravity);
  record.stiffness_fit = fit_stiffness(
      as_set, gravity, [&](const auto& x) { return state.distance(x); }, {},
      part_of(stage, 0, 0.6));
  return factor * record.stiffness_fit->factor;
}

void hang_in_other_poses(const BreastProblem& unloaded, const StageRun& stage,
                         UnloadingRecord& record) {
  double done = 0.6;
  for (const Pose pose : {Pose::standing, Pose::supine}) {
    stage.progress(done, "coming to rest " + std::string(name_of(pose)));
    done += 0.2;
    BreastProblem problem = unloaded;
    problem.gravity = gravity_in_lps(pose);
    PoseState state{hang(problem, to_another_pose())};
    state.wall_slide_mm =
        wall_slide(problem.mesh, problem.mesh.mesh.nodes(), state.result.deformed);
    state.move_mm = largest_distance(state.result.deformed, problem.prone);
    record.poses.emplace(name_of(pose), std::move(state));
  }
}

MeshFile unloaded_file(const MeshFile& prone, const UnloadResult& result,
                       const UnloadingRecord& record) {
  MeshFile file = prone;
  file.configurations["prone"] = prone.mesh.nodes();
  for (const auto& [name, pose] : record.poses)
    if (pose.result.report.usable()) file.configurations[name] = pose.result.deformed;
  file.mesh = HermiteMesh(result.unloaded, prone.mesh.elements());
  write_stiffness_factor(record.stiffness_factor, file);
  return file;
}

Outcome run(const Arguments& args, const Patient& patient, StageRun& stage) {
  reserve_blas_memory();
  const Segmentation segmentation = read_segmentation(args.segmentation, args.fractions);
  const MeshFile prone = read_mesh_file(args.mesh);
  const TissueSampler tissue = tissue_of(prone, segmentation.fractions);
  const Pose imaged = patient.imaged_pose(patient_position(args.segmentation));
  UnloadingRecord record;
  record.imaged = imaged;
  if (imaged != Pose::none)
    record.coil =
        find_pressed_sides(prone, std::max(kFlat, patient.gravity.coil_roundness.value_or(0)));
  const auto problem_with = [&](double factor) {
    BreastProblem problem = breast_problem(prone, tissue, patient.compression, factor);
    problem.gravity = gravity_in_lps(imaged);
    problem.density = patient.gravity.density();
    return problem;
  };
  record.stiffness_factor =
      find_stiffness(patient, stage, problem_with(patient.compression.stiffness_factor), record);
  if (record.stiffness_fit && !record.stiffness_fit->usable()) return judge_unloading(record);
  BreastProblem problem = problem_with(record.stiffness_factor);
  if (record.coil)
    record.release = release_from_coil(problem, *record.coil, patient.gravity.coil_roundness,
                                       part_of(stage, 0, 0.2));
  const UnloadResult result =
      record.release
          ? unload_released(problem, *record.coil, record.release, part_of(stage, 0.2, 0.4))
          : unload(problem, {}, part_of(stage, 0, 0.6));
  record.report = result.report;
  stiffen_as_needed(record);
  if (record.report.usable()) {
    if (record.imaged != Pose::none)
      hang_in_other_poses(from_unloaded(problem_with(record.stiffness_factor), result.unloaded),
                          stage, record);
    MeshFile file = unloaded_file(prone, result, record);
    if (record.release)
      file.configurations[kRounderByCoil] =
          rounder_shape(problem, *record.coil, result, 1 / record.stiffened, kCoilRoundnessSd);
    write_mesh_file(stage.products.write_main(), file);
  }
  return judge_unloading(record);
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_stage(argc, argv, "unload",
                   "the breast as imaged -> its shape free of stress, for compress", declare, plan,
                   run);
}
