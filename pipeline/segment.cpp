// segment: MRI or label map -> tissue labels and fractions of one breast.

#include "segmentation/segment.h"

#include "pipeline/frame/stage.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path segmentation;
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.product("segmentation", args.segmentation, "tissue labels to write (.seg.nrrd)");
  for (const char* prefix : {"side", "mri.", "labels.", "nipple."})
    stage.options_from(prefix, false);
  stage.options_from("segment.", true);
}

StagePlan plan(const Arguments&, const Patient& patient) {
  return {patient.segment_files(), {"side", "mri.", "labels.", "nipple.", "segment.", "lesions."}};
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

Outcome run(const Arguments&, StageRun& stage) {
  const SegmentResult result =
      segment(stage.patient.segment_input(), stage.patient.segment, stage.progress);
  stage.progress(0.95, "writing");
  write_segmentation(stage.products.write_main(), result.segmentation);
  write_fractions(stage.products.write("fractions.nrrd"), result.segmentation.fractions);
  if (!result.image.values.empty()) write_image(stage.products.write("mri.nrrd"), result.image);
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
