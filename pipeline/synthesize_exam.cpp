// synthesize-exam: a synthetic patient as a hospital would send her: an MRI series and mammograms
// in DICOM, these made by another model than the one that registers.

#include <iostream>
#include <nlohmann/json.hpp>

#include "pipeline/frame/command_line.h"
#include "pipeline/frame/partial_path.h"
#include "pipeline/frame/products.h"
#include "pipeline/patient/compression_settings.h"
#include "pipeline/synthesize/patient_files.h"
#include "pipeline/synthesize/views/exam_dicom.h"
#include "pipeline/synthesize/views/true_mammogram.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path folder;
  int seed = 42;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("folder", args.folder, "to write the exam to; it must not be there yet")
      .required();
  command.option("--seed", args.seed, "another number, another patient").with_default();
}

/// On a mesh of its own, with gland twice as stiff as is assumed,
/// and views taken a little otherwise than their headers say.
DrawnPatient drawn_exam(int seed) {
  DrawnPatient drawn;
  drawn.patient.anatomy.seed = static_cast<std::uint64_t>(seed);
  drawn.true_elements = {5, 5, 2};
  const CompressionSettings assumed;
  drawn.tissue.stiffness_ratio = 2 * assumed.fibroglandular.c1_kpa / assumed.fat.c1_kpa;
  drawn.views = {DrawnView{.name = "cc",
                           .roll_deg = 2,
                           .turn_deg = -2,
                           .lift_mm = 2,
                           .clearance_mm = 8,
                           .shift_mm = 6,
                           .thickness_error_mm = 1},
                 DrawnView{.name = "mlo",
                           .header_angle_deg = 45,
                           .roll_deg = -2,
                           .turn_deg = 2,
                           .lift_mm = -2,
                           .clearance_mm = 9,
                           .shift_mm = -8,
                           .thickness_error_mm = -1}};
  return drawn;
}

/// Where the lesions truly are in the mammogram, to compare with what was predicted.
json true_places(const TrueBreast& breast, const TrueView& view, const Detector& detector) {
  json places = json::object();
  for (const Lesion& lesion : breast.truth().lesions) {
    const Eigen::Vector2d pixel = true_mark(breast, view, detector, lesion.centroid_in_lps);
    const Eigen::Vector2d uv = detector.detector_from_image(pixel);
    places[lesion.id] = {{"pixel", {pixel.x(), pixel.y()}}, {"detector_mm", {uv.x(), uv.y()}}};
  }
  return places;
}

int run(const Arguments& args) {
  if (fs::exists(args.folder))
    throw std::runtime_error(args.folder.string() + ": is there already; name another folder");
  const DrawnPatient drawn = drawn_exam(args.seed);
  const Side side = drawn.patient.anatomy.side;
  std::cerr << "synthesize-exam: body and MRI" << std::endl;
  const SyntheticPatient patient = make_patient(drawn.patient);
  const fs::path given = fs::absolute(args.folder).lexically_normal();
  const fs::path folder = given.has_filename() ? given : given.parent_path();
  const std::string name = folder.filename().string();
  remove_partial_leftovers(folder.parent_path(), name);
  const fs::path part = partial_path(folder.parent_path(), name);
  write_mri_series(part / "mri", patient.scan.image, args.seed);
  const TrueBreast breast(patient, drawn);
  const Detector detector = synthetic_detector(side);
  json truth = truth_json(patient);
  for (const DrawnView& view : drawn.views) {
    std::cerr << "synthesize-exam: " << view.name << std::endl;
    const TrueView taken = breast.compress_view(view);
    write_mammogram(part / (view.name + ".dcm"), true_mammogram(breast, taken, detector, args.seed),
                    detector, {view.name, side, view.header_angle_deg, taken.header_thickness_mm},
                    args.seed);
    truth["places"][view.name] = true_places(breast, taken, detector);
  }
  write_text_atomically(part / "truth.json", truth.dump(1) + "\n");
  fs::rename(part, folder);
  std::cerr << "synthesize-exam: wrote " << args.folder.string() << std::endl;
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "synthesize-exam",
      "A synthetic patient's MRI series and mammograms in DICOM, the mammograms by another model "
      "than the one that registers",
      declare, run);
}
