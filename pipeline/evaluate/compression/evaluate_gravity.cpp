// evaluate-gravity: lays every breast of a folder of cases on its back, unattended -> one table.

#include <nlohmann/json.hpp>
#include <optional>

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/compression/gravity_row.h"
#include "pipeline/evaluate/compression/typical_press.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path cases, table;
  fs::path population;
  std::string preset;
  std::vector<std::string> only, unload_options;
  int jobs = 2;
  bool keep = false;
};

void declare(CommandLine& command, Arguments& args) {
  declare_cases(command, args.cases);
  declare_table(command, args.table, "gravity");
  declare_only(command, args.only);
  declare_keep(command, args.keep);
  declare_jobs(command, args.jobs);
  command.option("--unload", args.unload_options,
                 "options of mammotwin-unload (such as --unload=--stiffness-factor "
                 "--unload=0.4)");
  command.option("--preset", args.preset, "the tissue's materials.preset");
  command
      .option("--population", args.population,
              "folder with PCAmean.csv, PCA1.csv ...: press each breast in CC, too, to the "
              "thickness that is typical of its volume")
      .existing_folder();
}

int run(const Arguments& args) {
  EvaluationTable table(args.table, args.keep);
  std::vector<RealBreast> breasts = asked_breasts(args.cases, args.only);
  for (RealBreast& breast : breasts) breast.preset = args.preset;
  std::optional<OutlinePopulation> population;
  if (!args.population.empty()) population.emplace(args.population);
  work_through(breasts.size(), args.jobs, [&](std::size_t n) {
    const fs::path folder = table.folder() / "gravity" / name_and_side(breasts[n]);
    json row = gravity_row(breasts[n], folder, args.unload_options);
    if (population) add_plates(folder, *population, row);
    table.add(n, std::move(row));
  });
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(argc, argv, "evaluate-gravity",
                                      "Lays every breast of a folder of cases on its back and "
                                      "writes how far nipple and tissue move",
                                      declare, run);
}
