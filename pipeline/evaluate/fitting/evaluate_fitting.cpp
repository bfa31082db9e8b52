// evaluate-fitting: fits every breast of a folder of cases, unattended -> one table.

#include <sstream>

#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/fitting/fitting_row.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path cases, table;
  std::string only;
  FitRun fit;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("cases", args.cases, "folder with label_maps/*.nii.gz and mimbcd_*/mri")
      .required()
      .existing_folder();
  command
      .option("table", args.table,
              "fitting.json to write; each breast's files go to the folder fitting beside it")
      .required();
  command.option("--only", args.only, "breasts whose name-side contains this (text)");
  command.flag("!--keep", args.fit.again, "do not fit again what is up to date (its times stay)");
  command.option("--fit", args.fit.options,
                 "options of mammotwin-fit (such as --fit=--accuracy-mm --fit=0.3)");
}

std::string line_of(const json& row) {
  std::ostringstream line;
  line << row["name"].get<std::string>() << " " << row["side"].get<std::string>() << ": "
       << row["status"].get<std::string>();
  for (const char* key :
       {"skin_rms_mesh_to_data_mm", "skin_rms_data_to_mesh_mm", "skin_p95_mm", "skin_max_mm",
        "nipple_error_mm", "chest_wall_rms_mm", "min_scaled_jacobian", "covered_fraction",
        "fat_volume_error", "fibroglandular_volume_error", "lesions", "seconds", "cpu_seconds",
        "peak_memory_mb"})
    if (row.contains(key)) line << "  " << key << " " << row[key];
  if (!row["reason"].is_null()) line << "  " << row["reason"].get<std::string>();
  return line.str();
}

int run(const Arguments& args) {
  EvaluationTable table(args.table);
  std::size_t breasts = 0;
  for (const RealBreast& breast : real_breasts(args.cases)) {
    const std::string name = name_and_side(breast);
    if (name.find(args.only) == std::string::npos) continue;
    json row = fitting_row(breast, table.folder() / "fitting" / name, args.fit);
    const std::string line = line_of(row);
    table.add(breasts++, std::move(row), line);
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
      argc, argv, "evaluate-fitting",
      "Fits every breast of a folder of cases and writes the figures of each", declare, run);
}
