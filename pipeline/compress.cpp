// compress: Hermite mesh + tissue + plates -> the mesh as it lies between the plates of one view.

#include "solver/press/compress.h"

#include "fitting/mesh/inverse_map.h"
#include "pipeline/frame/stage.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/breast_problem.h"
#include "pipeline/steps/compression_course.h"
#include "pipeline/steps/compression_quality.h"
#include "pipeline/steps/view_header.h"
#include "pipeline/steps/view_problem.h"
#include "registration/view/breast_middle.h"
#include "registration/view/plate_turn.h"
#include "registration/view/view_of_plates.h"
#include "segmentation/segmentation_file.h"
#include "solver/newton/blas_kernels.h"
#include "solver/press/check_shape.h"
#include "solver/press/checkpoint.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::string view;
  std::filesystem::path segmentation, fractions, mesh, compressed;
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.command()
      .option("view", args.view, "which view of patient.toml")
      .required()
      .one_of({"cc", "mlo"});
  stage.input("segmentation", args.segmentation, "tissue labels from segment (.seg.nrrd)");
  stage.input("fractions", args.fractions, "tissue fractions from segment (.nrrd)");
  stage.input("mesh", args.mesh, "Hermite mesh from unload, or from fit (.vtu)");
  stage.product("compressed", args.compressed, "compressed mesh to write (.vtu)");
  stage.options_from("compress.", true);
  stage.options_from("materials.", false);
  stage.options_from("unload.density", false);
  for (const char* key : {"thickness_mm", "angle_deg", "turn_deg", "lift_mm"})
    for (const char* view : {"cc", "mlo"})
      stage.options_from(std::string("views.") + view + "." + key, false);
}

StagePlan plan(const Arguments& args, const Patient& patient) {
  std::vector<std::filesystem::path> files;
  for (const auto& stl : {patient.compression.support_stl, patient.compression.paddle_stl})
    if (stl) files.push_back(patient.resolve(*stl));
  if (const auto file = dicom_mammogram(patient, args.view)) files.push_back(*file);
  const std::string view = "views." + args.view + ".";
  return {files,
          {"compress.", "materials.", "unload.density", view + "thickness_mm", view + "angle_deg",
           view + "turn_deg", view + "lift_mm"}};
}

MeshFile compressed_file(const MeshFile& reference, const CompressionResult& result,
                         const CompressedView& view) {
  MeshFile file = reference;
  const bool was_unloaded = reference.configurations.contains("prone");
  file.configurations[was_unloaded ? "unloaded" : "prone"] = reference.mesh.nodes();
  file.mesh = HermiteMesh(result.deformed, reference.mesh.elements());
  file.fields.insert(result.fields.begin(), result.fields.end());
  write_view(view, file.metadata);
  remember_solution(result, file);
  remember_course(result.report, file);
  return file;
}

PlateEscape escape_of(const MeshFile& mesh, const MeshPoint& nipple,
                      const CompressionResult& result, const CompressedView& view) {
  const auto with = [&](const std::vector<HermiteMesh::Node>& nodes) {
    return HermiteMesh(nodes, mesh.mesh.elements());
  };
  return plate_escape(with(result.found), with(result.deformed), nipple, view.frame);
}

/// Endless plates have no middle of their own: a radiographer lays the breast on the detector's.
void centre_detector(const HermiteMesh& mesh, const CompressionResult& result,
                     CompressedView& view) {
  const double middle = breast_middle_mm({result.deformed, mesh.elements()}, view.frame);
  view.frame.origin_in_lps += middle * view.frame.axes.row(1).transpose();
}

/// How far a run that was interrupted had come, if it was of the same problem.
std::optional<CompressionCheckpoint> interrupted_run(const StageRun& stage) {
  const auto bytes = stage.checkpoint.read();
  if (!bytes) return std::nullopt;
  try {
    CompressionCheckpoint found = decode_checkpoint(*bytes, stage.checkpoint.run());
    stage.progress(found.load.reached, "goes on where an interrupted run stopped");
    return found;
  } catch (const std::runtime_error&) {  // another problem's, or damaged: begin anew
    return std::nullopt;
  }
}

CompressionResult compress_with_checkpoints(const CompressionProblem& problem,
                                            const CompressionOptions& options,
                                            const StageRun& stage) {
  const auto interrupted = interrupted_run(stage);
  CompressionRestart restart;
  if (interrupted) restart.from = &*interrupted;
  restart.keep = [&](const CompressionCheckpoint& good) {
    stage.checkpoint.write(encode_checkpoint(good, stage.checkpoint.run()));
  };
  return compress(problem, options, stage.progress, restart);
}

Outcome run(const Arguments& args, const Patient& patient, StageRun& stage) {
  reserve_blas_memory();
  const Segmentation segmentation = read_segmentation(args.segmentation, args.fractions);
  const Side side = segmentation.region.side;
  std::vector<std::string> remarks;
  const ViewSettings view = with_header(patient, args.view, side, remarks);
  require_whole_mammogram(patient, args.view);

  const MeshFile mesh = read_mesh_file(args.mesh);
  const HermiteMesh imaged = prone_file(mesh).mesh;
  check_shape(mesh.mesh, imaged);  // before anything is sought in it
  const MeshPoint nipple = InverseMap(imaged).nearest(segmentation.nipple_in_lps);
  const double turn_deg =
      view.turn_deg ? *view.turn_deg : usual_turn_deg(mesh, nipple, side, view.angle());
  const Eigen::Matrix3d axes = axes_of(side, view.angle(), turn_deg);
  const CompressionProblem problem =
      view_problem(patient, view, axes, mesh, tissue_of(mesh, segmentation.fractions));
  const CompressionResult result =
      compress_with_checkpoints(problem, patient.compression.options, stage);
  PlateEscape escape;
  if (result.report.usable()) {
    CompressedView pressed =
        view_of_plates(args.view, side, view.angle(), turn_deg, problem.plates, result);
    if (problem.plates.endless_sideways()) centre_detector(mesh.mesh, result, pressed);
    escape = pressed.escape = escape_of(mesh, nipple, result, pressed);
    write_mesh_file(stage.products.write_main(), compressed_file(mesh, result, pressed));
  }
  Outcome outcome = judge_compression(result.report, escape, view.angle(), !view.thickness_mm);
  outcome.quality["turn_deg"] = turn_deg;
  if (!remarks.empty()) outcome.quality["header"] = remarks;
  return outcome;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_stage(argc, argv, "compress",
                   "Hermite mesh + tissue + plates -> the mesh between the plates of one view",
                   declare, plan, run);
}
