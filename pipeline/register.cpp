// register: compressed meshes + view geometry -> lesions on the CC and MLO detectors.

#include <iostream>

#include "pipeline/frame/sidecar.h"
#include "pipeline/frame/stage.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/dicom_products.h"
#include "pipeline/steps/lesion_ellipses.h"
#include "pipeline/steps/projected_findings.h"
#include "pipeline/steps/registration_products.h"
#include "pipeline/steps/searched_views.h"
#include "pipeline/steps/view_header.h"
#include "registration/export/detector_record.h"
#include "registration/export/predictions_text.h"
#include "segmentation/segmentation_file.h"
#include "solver/newton/blas_kernels.h"

namespace mammotwin {
namespace {

using nlohmann::json;

constexpr double kSearchShare = 0.8;  // of the stage's time, for the progress line

struct Arguments {
  std::filesystem::path segmentation, fractions, cc, mlo, lesions, landmarks;

  /// Where segment has left the MRI; a patient that came as labels has none.
  std::filesystem::path mri() const { return segmentation.parent_path() / "mri.nrrd"; }
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.input("segmentation", args.segmentation, "tissue labels from segment (.seg.nrrd)");
  stage.input("fractions", args.fractions, "tissue fractions from segment (.nrrd)");
  stage.input_or_failure("cc", args.cc, "breast compressed in CC (.vtu)");
  stage.input_or_failure("mlo", args.mlo, "breast compressed in MLO (.vtu)");
  stage.product("lesions", args.lesions, "table of lesions to write (.csv; .mrk.json beside it)");
  for (const char* view : {"cc", "mlo"})
    for (const char* key : {".detector.", ".mammogram", ".nipple_pixel", ".pectoral", ".outline"})
      stage.options_from(std::string("views.") + view + key, false);
  stage.options_from("register.", true);
  stage.command()
      .option("--landmarks", args.landmarks,
              "points found in MRI and mammograms (.csv): print how far predictions are off")
      .existing_file();
}

StagePlan plan(const Arguments& args, const Patient& patient) {
  StagePlan plan{
      {}, {"views.", "register.", "compress.", "materials.", "unload.density", "dicom_export"}};
  for (const ViewSettings* view : {&patient.cc, &patient.mlo})
    for (const auto& file : {view->mammogram, view->outline})
      if (file) plan.inputs.push_back(patient.resolve(*file));
  if (std::filesystem::exists(args.mri())) plan.inputs.push_back(args.mri());
  if (!args.landmarks.empty()) plan.inputs.push_back(args.landmarks);
  return plan;
}

struct Inputs {
  Segmentation segmentation;
  std::optional<Volume<float>> mri;
  std::vector<RegisteredView>
      views;  ///< as compress left them; one that it did not reach is left out
  std::vector<std::string> remarks;  ///< on such views, and on the mammograms' headers
};

Inputs read_inputs(const Arguments& args, const Patient& patient) {
  Inputs inputs{read_segmentation(args.segmentation, args.fractions), {}, {}, {}};
  if (std::filesystem::exists(args.mri())) inputs.mri = read_image_file(args.mri());
  for (const auto& [name, path] : {std::pair("cc", args.cc), std::pair("mlo", args.mlo)}) {
    if (const auto reasons = reasons_of_failure(path); !reasons.empty()) {
      inputs.remarks.push_back("no positions in " + std::string(name) + ": " + reasons.front());
      continue;
    }
    const Side side = inputs.segmentation.region.side;
    if (!patient.registration.search) require_whole_mammogram(patient, name);
    inputs.views.push_back(
        read_registered_view(name, path, with_header(patient, name, side, inputs.remarks)));
  }
  if (inputs.views.empty())
    throw std::runtime_error("no view could be compressed: " + inputs.remarks.front());
  return inputs;
}

RegisteredViews search(const Patient& patient, const Inputs& inputs, const StageRun& stage) {
  if (!patient.registration.search) return {inputs.views, {}, {}};
  return search_and_register(
      patient, inputs.segmentation, inputs.views,
      [&](double done, const std::string& what) { stage.progress(kSearchShare * done, what); });
}

PredictedView predict(const Patient& patient, const Findings& findings,
                      const RegisteredView& view) {
  PredictedView predicted{view, project(findings, view.projection), {}};
  const bool has_mammogram = patient.view(view.projection.view().name).mammogram.has_value();
  predicted.ellipses = lesion_ellipses(predicted.findings, view, has_mammogram);
  return predicted;
}

/// Everything of one view; what the sidecar says of it goes to `quality`.
void write_view_products(const Patient& patient, const Inputs& inputs, const PredictedView& view,
                         Products& products, json& quality) {
  const ViewProjection& projection = view.registered.projection;
  const std::string& name = projection.view().name;
  quality["detectors"][name] = detector_record(projection.detector());
  write_prediction(view, products);
  const DetectorImage shown =
      write_view_files(view.registered, inputs.segmentation, inputs.mri, products, quality);
  if (!patient.registration.dicom_export) return;
  const auto mammogram = dicom_mammogram(patient, name);
  if (!mammogram) return;
  write_dicom_products(view, shown, *mammogram, products);
  quality["dicom_export"] =
      "dicom/ carries the patient and study attributes of the mammograms, as dicom_export asks";
}

Outcome outcome_of(const Inputs& inputs, const RegisteredViews& registered,
                   const std::vector<PredictedView>& views, json quality) {
  std::vector<std::string> reasons = inputs.remarks;
  reasons.insert(reasons.end(), registered.remarks.begin(), registered.remarks.end());
  for (const PredictedView& view : views) {
    const std::vector<std::string> remarks =
        edge_remarks(view.findings, view.ellipses, view.registered.projection.view().name);
    reasons.insert(reasons.end(), remarks.begin(), remarks.end());
  }
  if (inputs.segmentation.lesions.empty())
    reasons.push_back("patient.toml names no lesion, so there is nothing to predict");
  return {reasons.empty() ? Status::ok : Status::look, reasons, std::move(quality)};
}

Outcome run(const Arguments& args, const Patient& patient, StageRun& stage) {
  reserve_blas_memory();
  stage.progress(0, "reading");
  const Inputs inputs = read_inputs(args, patient);
  const Findings findings = findings_of(inputs.segmentation);
  const RegisteredViews registered = search(patient, inputs, stage);

  std::vector<PredictedView> views;
  for (const RegisteredView& view : registered.views)
    views.push_back(predict(patient, findings, view));

  json quality{{"lesions", findings.lesions.size()}};
  if (patient.registration.search) quality["search"] = registered.figures;
  write_states(findings, registered.views.front(), stage.products);
  double done = kSearchShare;
  for (const PredictedView& view : views) {
    stage.progress(done, view.registered.projection.view().name);
    write_view_products(patient, inputs, view, stage.products, quality);
    done += (1 - kSearchShare) / views.size();
  }
  if (patient.registration.dicom_export)
    write_dicom_segmentation(patient, inputs.segmentation, stage.products);
  std::vector<LesionRow> rows =
      lesion_rows(patient.name(), inputs.segmentation.region.side, findings, views);
  add_extent(inputs.segmentation, rows);
  add_supine(findings, registered.views.front(), rows);
  write_lesion_table(stage.products.write_main(), rows);
  write_lesion_dictionary(stage.products.write("lesions.csv.md"));
  if (!args.landmarks.empty()) std::cout << landmark_errors(args.landmarks, registered.views);
  return outcome_of(inputs, registered, views, std::move(quality));
}

std::string predictions(const Arguments& args) {
  return predictions_text(read_lesion_table(args.lesions));
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_stage(argc, argv, "register",
                   "compressed meshes + view geometry -> lesions on the CC and MLO detectors",
                   declare, plan, run, predictions);
}
