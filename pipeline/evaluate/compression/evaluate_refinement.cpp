// evaluate-refinement: breasts pressed with coarser and finer meshes -> one table.

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/compression/refinement_rows.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path patient, cases, table;
  std::vector<std::string> only, meshes;
};

void declare(CommandLine& command, Arguments& args) {
  declare_patient(command, args.patient);
  declare_cases(command, args.cases);
  declare_table(command, args.table, "refinement");
  declare_only(command, args.only);
  command.option("--meshes", args.meshes,
                 "elements, the finest first: 16x16x3, default, ... (default: 16x16x3, 12x12x3, "
                 "9x9x3, 7x7x2 and what fit chooses)");
}

int run(Arguments args) {
  if (args.meshes.empty()) args.meshes = {"16x16x3", "12x12x3", "9x9x3", "7x7x2", "default"};
  EvaluationTable table(args.table);
  const auto breasts =
      breasts_to_press(args.patient, args.cases, args.only, table.folder() / "refinement");
  for (std::size_t n = 0; n < breasts.size(); ++n)
    add_refinement_rows(breasts[n], args.meshes,
                        [&](const nlohmann::json& row) { table.add(n, row); });
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-refinement",
      "Presses breasts with coarser and finer meshes, and writes how force, contact and places "
      "converge",
      declare, run);
}
