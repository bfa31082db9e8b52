// evaluate-unload: unloads patients' breasts with three stiffnesses, and says what it changes.

#include <fstream>

#include "pipeline/evaluate/cases/breast_inputs.h"
#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/unload_rows.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kMostCpuSeconds = 3600;  // a segmentation or fit takes some 30

struct Arguments {
  fs::path table, cases;
  std::vector<std::string> only;
  bool views = false;
};

void declare(CommandLine& command, Arguments& args) {
  declare_cases(command, args.cases);
  command
      .option("table", args.table,
              "unload.json to write; inputs of each breast go to the folder compression beside it, "
              "shared with evaluate-compression")
      .required();
  declare_only(command, args.only);
  command.flag("--views", args.views, "compress with and without unloading, too");
}

/// A patient's MRI, segmented round the radiologist's first lesion and fitted.
void prepare_mri(const fs::path& patient, const fs::path& folder) {
  if (fs::exists(folder / "prone.vtu")) return;
  fs::create_directories(folder);
  const auto radiologist = json::parse(std::ifstream(patient / "lesions_radiologist.json"));
  const json& lesion = radiologist.at("mri").at(0);
  std::ostringstream toml;
  toml << "side = \"" << (lesion.at("side") == "L" ? "left" : "right")
       << "\"\n[mri]\npath = " << json(fs::canonical(patient / "mri").string())
       << "\n[[lesions]]\npoint_lps_mm = " << lesion.at("centroid_lps_mm") << "\n";
  write_text_atomically(folder / "patient.toml", toml.str());
  const auto file = [&](const char* name) { return (folder / name).string(); };
  run_stage_command("segment", {file("segmentation.seg.nrrd"), "--patient", file("patient.toml")},
                    folder / "segment.log", kMostCpuSeconds);
  run_stage_command("fit",
                    {file("segmentation.seg.nrrd"), file("fractions.nrrd"), file("prone.vtu")},
                    folder / "fit.log", kMostCpuSeconds);
  if (!fs::exists(folder / "prone.vtu"))
    throw std::runtime_error("not segmented or not fitted; see segment.log and fit.log");
}

struct Breast {
  std::string name;
  std::function<void(const fs::path& folder)> prepare;
};

std::vector<Breast> breasts_of(const Arguments& args) {
  std::vector<Breast> all;
  for (const LabelMapBreast& map : label_map_breasts(args.cases)) {
    const std::string name = map.exam + "-" + name_of(map.side);
    all.push_back({name, [map, name](const fs::path& folder) {
                     const PreparedBreast made = prepare_breast({name, folder, {}, map}, false);
                     if (!made.usable()) throw std::runtime_error(made.reason);
                   }});
  }
  for (const fs::path& entry : sorted_entries(args.cases))
    if (entry.filename().string().starts_with("mimbcd_"))
      all.push_back({entry.filename().string(),
                     [entry](const fs::path& folder) { prepare_mri(entry, folder); }});
  return all;
}

/// A failed breast stays in the table with its reason.
json evaluate(const Breast& breast, const fs::path& folder, bool views) {
  json row = {{"name", breast.name}, {"reason", nullptr}};
  try {
    breast.prepare(folder);
    row.update(unload_rows(folder));
    if (views) row["view_shifts"] = view_shifts(folder);
  } catch (const std::exception& error) {
    row["reason"] = error.what();
  }
  return row;
}

int run(const Arguments& args) {
  EvaluationTable table(args.table);
  std::size_t breasts = 0;
  for (const Breast& breast : breasts_of(args)) {
    if (!is_asked(breast.name, args.only)) continue;
    table.add(breasts++,
              evaluate(breast, table.folder() / "compression" / breast.name, args.views));
  }
  if (breasts == 0)
    throw std::runtime_error(args.cases.string() +
                             ": no label_maps/*_labels.nii.gz and no mimbcd_* in it");
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-unload",
      "Unloads patients' breasts with three stiffnesses and writes how well that went", declare,
      run);
}
