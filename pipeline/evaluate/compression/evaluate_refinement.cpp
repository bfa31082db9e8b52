// evaluate-refinement: breasts pressed with coarser and finer meshes -> one table.

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/compression/breast_stages.h"
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
                 "elements, the finest first: 16x16x3, default (what fit chooses), ... (default: "
                 "16x16x3, 12x12x2, 10x10x2, 9x9x2, 8x8x2, 7x7x2)");
}

int run(Arguments args) {
  if (args.meshes.empty())
    args.meshes = {"16x16x3", "12x12x2", "10x10x2", "9x9x2", "8x8x2", "7x7x2"};
  tabulate_breasts(
      args.patient, args.cases, args.only, args.table,
      [&](const auto& breast, const auto& add) { add_refinement_rows(breast, args.meshes, add); });
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
