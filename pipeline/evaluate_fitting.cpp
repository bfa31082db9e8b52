// evaluate-fitting: fits every breast of a folder of cases, unattended -> one table.

#include <iostream>

#include "pipeline/evaluate/fitting_row.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"

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

void say(const json& row) {
  std::cerr << row["name"].get<std::string>() << " " << row["side"].get<std::string>() << ": "
            << row["status"].get<std::string>();
  for (const char* key :
       {"skin_rms_mesh_to_data_mm", "skin_rms_data_to_mesh_mm", "skin_p95_mm", "skin_max_mm",
        "nipple_error_mm", "chest_wall_rms_mm", "min_scaled_jacobian", "covered_fraction",
        "fat_volume_error", "fibroglandular_volume_error", "lesions", "seconds", "cpu_seconds",
        "peak_memory_mb"})
    if (row.contains(key)) std::cerr << "  " << key << " " << row[key];
  if (!row["reason"].is_null()) std::cerr << "  " << row["reason"].get<std::string>();
  std::cerr << std::endl;
}

int run(const Arguments& args) {
  const fs::path beside = fs::absolute(args.table).parent_path();
  fs::create_directories(beside);
  json rows = json::array();
  for (const RealBreast& breast : real_breasts(args.cases)) {
    const std::string name = breast.name + (breast.side == Side::left ? "-left" : "-right");
    if (name.find(args.only) == std::string::npos) continue;
    rows.push_back(fitting_row(breast, beside / "fitting" / name, args.fit));
    say(rows.back());
    write_text_atomically(args.table, json{{"cases", rows}}.dump(1) + "\n");
  }
  if (rows.empty())
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
