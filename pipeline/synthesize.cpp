// synthesize: seed and options -> a synthetic patient's folder, with its truth.

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "pipeline/frame/process.h"
#include "pipeline/frame/products.h"
#include "pipeline/frame/stage_declaration.h"
#include "pipeline/synthesize/hanging_truth.h"
#include "pipeline/synthesize/nrrd_file.h"
#include "pipeline/synthesize/option_table.h"
#include "pipeline/synthesize/patient_files.h"
#include "pipeline/synthesize/slice_picture.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
constexpr int bad_data = 1, bad_usage = 2;
constexpr double white_over_fat = 3;  // lesions are about this bright

struct Arguments {
  fs::path folder;
  int seed = 42;
  std::optional<fs::path> picture;
  bool hang = false;
  PatientOptions options;
};

void declare(Settings& settings, Arguments& args) {
  settings.integer("seed", args.seed, {0, 2147483647, "-"}, "another number, another patient");
  settings.choice<Side>("side", args.options.anatomy.side,
                        {{"left", Side::left}, {"right", Side::right}}, "the breast with lesions");
  settings.choice<ScanContrast>(
      "contrast", args.options.scan.contrast,
      {{name_of(ScanContrast::fat_suppressed), ScanContrast::fat_suppressed},
       {name_of(ScanContrast::not_suppressed), ScanContrast::not_suppressed}},
      "T1, suppressed after or not suppressed before contrast agent");
  settings.flag("failed_suppression", args.options.scan.failed_suppression,
                "a patch in which fat stays bright (suppressed only)");
  visit_numbers(args.options, [&](const char* name, auto& variable, double low, double high,
                                  const char* unit, const char* help) {
    const Range range{low, high, unit};
    if constexpr (std::is_same_v<decltype(variable), int&>)
      settings.integer(name, variable, range, help);
    else
      settings.number(name, variable, range, help);
  });
}

/// A folder that holds a patient not made here is left alone.
void refuse_real_patient(const fs::path& folder) {
  if (fs::exists(folder / "patient.toml") && !fs::exists(folder / "truth.json"))
    throw std::runtime_error((folder / "patient.toml").string() +
                             ": exists and was not made by this program (there is no truth.json "
                             "beside it); name another folder");
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

void run(Arguments args) {
  args.options.anatomy.seed = args.seed;
  refuse_real_patient(args.folder);
  Products products(args.folder / "patient.toml");
  const SyntheticPatient patient = make_patient(args.options);
  write_nrrd(products.write("mri.nrrd"), patient.scan.image);
  write_nrrd(products.write("truth_labels.nrrd"), patient.labels);
  nlohmann::json truth = truth_json(patient);
  truth["version"] = MAMMOTWIN_VERSION;
  write_text(products.write("truth.json"), truth.dump(1) + "\n");
  write_text(products.write_main(), patient_toml(patient));
  if (args.hang) write_mesh_file(products.write("truth_unloaded.vtu"), hanging_truth(patient));
  if (args.picture)
    write_png(*args.picture,
              slice_picture(patient.scan.image, patient.truth.lesions.back().centroid_in_lps,
                            white_over_fat * fat_grey));
  products.commit();
  std::cerr << "synthesize: wrote " << args.folder.string() << "\n";
}

int synthesize(int argc, char** argv) {
  Arguments args;
  Settings settings;
  declare(settings, args);
  CommandLine command(
      "mammotwin-synthesize: a synthetic patient with known truth, for tests and trials.");
  StageDeclaration declaration(command, settings);
  declaration.product("folder", args.folder,
                      "to write patient.toml, mri.nrrd, truth.json and truth_labels.nrrd in");
  declaration.options_from("", false);
  command.flag(
      "--hang", args.hang,
      "write truth_unloaded.vtu, too: the shape that gravity turns into this patient's breast");
  command.option("--picture", args.picture, "PNG to draw slices through a lesion in");
  if (const auto code = command.parse(argc, argv)) return *code;
  try {
    for (const auto& given : declaration.given())
      settings.assign_text(given.flag, given.key, given.text);
  } catch (const BadSetting& e) {
    std::cerr << "synthesize: " << e.what() << "\n";
    return bad_usage;
  }
  try {
    run(args);
    return 0;
  } catch (const std::exception& e) {
    std::cerr << "synthesize: " << e.what() << "\n";
    return bad_data;
  }
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  mammotwin::prepare_process(argv);
  return mammotwin::synthesize(argc, argv);
}
