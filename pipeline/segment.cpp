// segment: MRI, label map or scanned skin -> tissue labels and fractions of one breast.

#include "segmentation/segment.h"

#include "fitting/scan/scanned_breast.h"
#include "fitting/tissue/tissue_volumes.h"
#include "pipeline/frame/stage.h"
#include "pipeline/patient/patient.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path segmentation;
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.product("segmentation", args.segmentation, "tissue labels to write (.seg.nrrd)");
  for (const char* prefix :
       {"side", "mri.", "labels.", "scan.", "nipple.", "chest_wall.", "region."})
    stage.options_from(prefix, false);
  stage.options_from("segment.", true);
}

StagePlan plan(const Arguments&, const Patient& patient) {
  patient.require_files();
  return {patient.segment_files(),
          {"side", "mri.", "labels.", "scan.", "nipple.", "chest_wall.", "region.", "segment.",
           "lesions."}};
}

Status status_of(SegmentStatus status) {
  switch (status) {
    case SegmentStatus::ok:
      return Status::ok;
    case SegmentStatus::look:
      return Status::look;
    case SegmentStatus::refused:
      return Status::refused;
  }
  throw std::logic_error("unknown segmentation status");
}

/// A scan has no tissue to tell apart: the breast in front of the base plane is all fat.
Outcome run_scan(const std::filesystem::path& file, const Patient& patient, StageRun& stage) {
  const ScannedBreast scanned = read_scanned_breast(file, patient.scan_options());
  const Segmentation& s = scanned.segmentation;
  write_segmentation(stage.products.write_main(), s);
  write_fractions(stage.products.write("fractions.nrrd"), s.fractions);
  SegmentQuality quality;
  quality.side = s.region.side;
  quality.contrast = "scan";
  quality.breast_volume_ml = quality.fat_ml = tissue_in_voxels(s).total();
  quality.nipple_in_lps = s.nipple_in_lps;
  quality.notes = {
      "a scanned skin: tissue in front of the base plane is taken as homogeneous (fat)",
      "the nipple was taken as the most anterior skin point"};
  nlohmann::json json = to_json(quality);
  json["scan"] = {{"points", scanned.points},
                  {"outliers", scanned.outliers},
                  {"holes", scanned.holes},
                  {"noise_mm", scanned.skin.noise_mm}};
  return {Status::ok, {}, json};
}

void write_for_others(const Segmentation& segmentation, const Volume<float>& image,
                      Products& products) {
  write_nifti_labels(products.write("labels.nii.gz"), segmentation.labels);
  if (!image.values.empty()) write_nifti_image(products.write("mri.nii.gz"), image);
}

Outcome run(const Arguments&, const Patient& patient, StageRun& stage) {
  if (const auto scan = patient.scan_file()) return run_scan(*scan, patient, stage);
  const SegmentResult result = segment(patient.segment_input(), patient.segment, stage.progress);
  stage.progress(0.95, "writing");
  write_segmentation(stage.products.write_main(), result.segmentation);
  write_fractions(stage.products.write("fractions.nrrd"), result.segmentation.fractions);
  if (!result.image.values.empty()) write_image(stage.products.write("mri.nrrd"), result.image);
  if (patient.nifti) write_for_others(result.segmentation, result.image, stage.products);
  return {status_of(result.quality.status), result.quality.reasons, to_json(result.quality)};
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_stage(argc, argv, "segment",
                   "MRI or label map -> tissue labels and fractions of one breast", declare, plan,
                   run);
}
