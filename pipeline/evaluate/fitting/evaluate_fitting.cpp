// evaluate-fitting: fits every breast of a folder of cases, and drawn ones, unattended -> one
// table.

#include <sstream>

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/fitting/fitting_row.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path cases, table;
  std::vector<std::string> only;
  int synthetic = 20;
  FitRun fit;
};

void declare(CommandLine& command, Arguments& args) {
  declare_cases(command, args.cases);
  command
      .option("table", args.table,
              "fitting.json to write; each breast's files go to the folder fitting (the table's "
              "name) beside it")
      .required();
  command.option("--synthetic", args.synthetic, "drawn breasts, fitted as they truly are")
      .between(0, 10000)
      .with_default();
  declare_only(command, args.only);
  command.flag("!--keep", args.fit.again, "do not fit again what is up to date (its times stay)");
  command.option("--fit", args.fit.options,
                 "options of mammotwin-fit (such as --fit=--accuracy-mm --fit=0.3)");
  command
      .option("--other-fit", args.fit.other_program,
              "mammotwin-fit of another build, to compare with")
      .existing_file();
}

std::string folder_name(const BreastToFit& breast) {
  return breast.name + "-" + name_of(breast.side);
}

std::vector<BreastToFit> breasts_asked(const Arguments& args) {
  std::vector<BreastToFit> all;
  for (const RealBreast& breast : real_breasts(args.cases)) all.push_back(to_fit(breast));
  if (all.empty())
    throw std::runtime_error(args.cases.string() +
                             ": no label_maps/*_labels.nii.gz and no mimbcd_* in it");
  for (int n = 0; n < args.synthetic; ++n) all.push_back(to_fit(draw_breast(n)));
  std::erase_if(
      all, [&](const BreastToFit& breast) { return !is_asked(folder_name(breast), args.only); });
  if (all.empty()) throw std::runtime_error("--only: no breast's name contains that");
  return all;
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
  const fs::path folder = table.folder() / args.table.stem();
  const std::vector<BreastToFit> breasts = breasts_asked(args);
  for (std::size_t n = 0; n < breasts.size(); ++n) {
    json row = fitting_row(breasts[n], folder / folder_name(breasts[n]), args.fit);
    const std::string line = line_of(row);
    table.add(n, std::move(row), line);
  }
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-fitting",
      "Fits every breast of a folder of cases, and drawn ones, and writes the figures of each",
      declare, run);
}
