// read-mammogram: one mammogram -> what is found in it and how sure that is (JSON), and a picture.

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "pipeline/frame/command_line.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/view_header.h"
#include "registration/export/png_file.h"
#include "registration/mammogram/findings_json.h"
#include "registration/mammogram/findings_picture.h"
#include "registration/mammogram/mammogram_header.h"
#include "registration/mammogram/mammogram_pixels.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path mammogram, patient, picture;
  std::string view;
  double pixel_mm = 0;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("mammogram", args.mammogram, "DICOM, or grey PNG or JPEG")
      .required()
      .existing_file();
  command.option("--view", args.view, "cc or mlo; default the header's").one_of({"cc", "mlo"});
  command.option("--pixel-mm", args.pixel_mm, "pixel on the detector [mm], for a picture")
      .between(0.02, 0.5);
  command
      .option("--patient", args.patient,
              "patient.toml whose views.cc.* (views.mlo.*) go before header and findings")
      .existing_file();
  command.option("--picture", args.picture, "findings drawn on the mammogram to write (.png)");
}

constexpr int kPictureRows = 1200;

int run(const Arguments& args) {
  const bool dicom = is_dicom(args.mammogram);
  std::string view = args.view;
  std::optional<MammogramHeader> header;
  if (dicom) header = read_mammogram_header(args.mammogram);
  if (header && view.empty()) view = view_said_in(*header);
  if (view != "cc" && view != "mlo")
    throw std::runtime_error(args.mammogram.string() +
                             ": no header says whether it is CC or MLO; give --view");
  Patient patient;
  if (!args.patient.empty()) patient.read(args.patient);
  const ViewSettings& settings = patient.view(view);
  json document{{"file", args.mammogram.filename().string()}, {"view", view}};
  double pixel_mm = settings.pixel_spacing_mm.value_or(args.pixel_mm);
  if (header) {
    const Side side = side_said_in(*header);
    const HeaderGeometry geometry = header_geometry(*header, view, side, overrides_of(settings));
    document["side"] = side == Side::left ? "left" : "right";
    document["geometry"] = geometry_json(geometry);
    pixel_mm = geometry.detector.pixels->spacing_mm;
  }
  if (!(pixel_mm > 0))
    throw std::runtime_error(args.mammogram.string() +
                             ": a picture says no pixel size; give --pixel-mm");
  const MammogramImage image = read_mammogram(args.mammogram);
  const MammogramFindings found =
      find_breast(image, pixel_mm, view == "mlo", said_in(patient, settings));
  document["findings"] = findings_json(found);
  document["pixel_mm"] = pixel_mm;
  if (!args.picture.empty())
    write_png(args.picture, findings_picture(image, pixel_mm, found, kPictureRows));
  std::cout << document.dump(1) << std::endl;
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(argc, argv, "read-mammogram",
                                      "What is found in a mammogram, and how sure that is", declare,
                                      run);
}
