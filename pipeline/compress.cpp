// compress: Hermite mesh + tissue + plates -> the mesh as it lies between the plates of one view.

#include "solver/compress.h"

#include "pipeline/breast_problem.h"
#include "pipeline/compression_quality.h"
#include "pipeline/frame/stage.h"
#include "registration/view_frame.h"
#include "segmentation/segmentation_file.h"
#include "solver/press/checkpoint.h"

#include <Eigen/Geometry>

namespace mammotwin {
namespace {

/// Of the breast's free extent, where nobody says how thick it was.
constexpr double kDefaultThicknessFraction = 0.45;

struct Arguments {
  std::string view;
  std::filesystem::path segmentation, fractions, mesh, compressed;
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.app().add_option("view", args.view, "which view of patient.toml")
      ->required()
      ->check(CLI::IsMember({"cc", "mlo"}));
  stage.input("segmentation", args.segmentation, "tissue labels from segment (.seg.nrrd)");
  stage.input("fractions", args.fractions, "tissue fractions from segment (.nrrd)");
  stage.input("mesh", args.mesh, "Hermite mesh from unload, or from fit (.vtu)");
  stage.product("compressed", args.compressed, "compressed mesh to write (.vtu)");
  stage.options_from("compress.", true);
  stage.options_from("materials.", false);
  stage.options_from("unload.density", false);
  for (const char* key : {"thickness_mm", "angle_deg", "lift_mm"})
    for (const char* view : {"cc", "mlo"})
      stage.options_from(std::string("views.") + view + "." + key, false);
}

StagePlan plan(const Arguments& args, const Patient& patient) {
  std::vector<std::filesystem::path> plates;
  for (const auto& stl : {patient.compression.support_stl, patient.compression.paddle_stl})
    if (stl) plates.push_back(patient.resolve(*stl));
  const std::string view = "views." + args.view + ".";
  return {plates,
          {"compress.", "materials.", "unload.density", view + "thickness_mm", view + "angle_deg",
           view + "lift_mm"}};
}

std::shared_ptr<const PlateMesh> facets(const std::filesystem::path& stl) {
  return std::make_shared<PlateMesh>(PlateMesh::read(stl));
}

PlateOptions plates_of(const Patient& patient, const ViewSettings& view,
                       const Eigen::Matrix3d& axes, const MeshFile& mesh) {
  PlateOptions plates;
  plates.depth = axes.row(0);
  plates.up = axes.row(2);
  plates.lift = view.lift_mm;
  const CompressionSettings& settings = patient.compression;
  settings.shape_plates(plates);
  if (settings.support_stl)
    plates.support_mesh = facets(patient.resolve(*settings.support_stl));
  if (settings.paddle_stl) plates.paddle_mesh = facets(patient.resolve(*settings.paddle_stl));
  plates.thickness =
      view.thickness_mm.value_or(kDefaultThicknessFraction * free_thickness(mesh, plates));
  return plates;
}

/// Middle of the detector's chest-wall edge on the support [mm, LPS].
Eigen::Vector3d view_origin(const PlateOptions& options, const PlacedPlates& placed) {
  return options.depth * placed.edge + options.up * placed.support_height +
         options.depth.cross(options.up) * placed.lateral_middle;
}

MeshFile compressed_file(const MeshFile& reference, const CompressionResult& result,
                         const PlateOptions& plates, const Eigen::Matrix3d& axes, Side side,
                         double angle_deg) {
  MeshFile file = reference;
  const bool was_unloaded = reference.configurations.contains("prone");
  file.configurations[was_unloaded ? "unloaded" : "prone"] = reference.mesh.nodes();
  file.mesh = HermiteMesh(result.deformed, reference.mesh.elements());
  file.fields.insert(result.fields.begin(), result.fields.end());
  const Eigen::Vector3d origin = view_origin(plates, result.plates);
  file.metadata["view_side"] = {side == Side::left ? 0.0 : 1.0};
  file.metadata["view_angle_deg"] = {angle_deg};
  file.metadata["thickness_mm"] = {result.report.thickness_mm};
  file.metadata["view_origin_lps_mm"] = {origin.begin(), origin.end()};
  const Eigen::Matrix3d columns = axes.transpose();
  file.metadata["view_axes"] = {columns.data(), columns.data() + columns.size()};
  return file;
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

Outcome run(const Arguments& args, StageRun& stage) {
  const Patient& patient = stage.patient;
  const ViewSettings& view = patient.view(args.view);
  const Segmentation segmentation = read_segmentation(args.segmentation, args.fractions);
  const Side side = segmentation.region.side;
  const Eigen::Matrix3d axes = view_axes(side, view.angle_deg);
  const MeanFractions mean(segmentation.fractions);

  const MeshFile mesh = read_mesh_file(args.mesh);
  CompressionProblem problem = breast_problem(mesh, mean, patient.compression,
                                              stiffness_factor_of(mesh, patient.compression));
  problem.friction = patient.compression.friction;
  problem.plates = plates_of(patient, view, axes, prone_file(mesh));
  if (patient.compression.standing_gravity) {
    problem.gravity = gravity_in_lps(Pose::standing);
    problem.density = patient.gravity.density();
  }

  const CompressionResult result =
      compress_with_checkpoints(problem, patient.compression.options, stage);
  if (result.report.usable())
    write_mesh_file(stage.products.write_main(),
                    compressed_file(mesh, result, problem.plates, axes, side, view.angle_deg));
  return judge_compression(result.report, view.angle_deg, !view.thickness_mm);
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_stage(argc, argv, "compress",
                   "Hermite mesh + tissue + plates -> the mesh between the plates of one view",
                   declare, plan, run);
}
