// fit: tissue labels -> tri-cubic Hermite mesh of the breast.

#include <iostream>

#include "fitting/fit_breast.h"
#include "pipeline/frame/stage.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/fit_quality.h"
#include "segmentation/segmentation_file.h"
#include "solver/newton/blas_kernels.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path segmentation, fractions, mesh;
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.input("segmentation", args.segmentation, "tissue labels from segment (.seg.nrrd)");
  stage.input("fractions", args.fractions, "tissue fractions from segment (.nrrd)");
  stage.product("mesh", args.mesh, "Hermite mesh to write (.vtu; an .exf beside it)");
  stage.options_from("fit.", true);
}

StagePlan plan(const Arguments&, const Patient& patient) {
  StagePlan plan{{}, {"fit."}};
  if (const auto scan = patient.scan_file()) {
    plan.inputs.push_back(*scan);
    plan.setting_prefixes.push_back("scan.");
  }
  return plan;
}

/// The skin that was scanned, in the segmentation's frame, where the patient has no image.
std::optional<ScannedSkin> scanned_skin(const Patient& patient) {
  const auto scan = patient.scan_file();
  if (!scan) return std::nullopt;
  return read_scanned_breast(*scan, patient.scan_options()).skin;
}

Outcome run(const Arguments& args, const Patient& patient, StageRun& stage) {
  reserve_blas_memory();
  const Segmentation segmentation = read_segmentation(args.segmentation, args.fractions);
  const std::optional<ScannedSkin> scan = scanned_skin(patient);
  const auto [mesh, report] =
      fit_breast(segmentation, patient.fit, stage.progress, scan ? &*scan : nullptr);
  std::cerr << fit_talk(report, patient.fit.verbosity);
  if (report.usable()) {
    write_mesh_file(stage.products.write_main(), mesh);
    write_exf(stage.products.write(args.mesh.stem().string() + ".exf"), mesh.mesh);
  }
  return judge_fit(report);
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_stage(argc, argv, "fit", "tissue labels -> tri-cubic Hermite mesh of the breast",
                   declare, plan, run);
}
