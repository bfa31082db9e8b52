// evaluate-what-if: the reduced models that a page may carry against full solves in the sliders'
// range -> one table.

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/registration/what_if_rows.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path patient, cases, table;
  std::vector<std::string> only = {"Exam_02-left", "Exam_11-right", "mimbcd_6e4da81a"};
  std::vector<std::string> views = {"cc", "mlo"};
  int states = 6;
};

void declare(CommandLine& command, Arguments& args) {
  declare_patient(command, args.patient);
  declare_cases(command, args.cases);
  declare_table(command, args.table, "what_if");
  declare_only(command, args.only);
  command.option("--views", args.views, "views to press");
  command.option("--states", args.states, "pressed in full, of each breast");
}

int run(const Arguments& args) {
  EvaluationTable table(args.table);
  const auto breasts =
      breasts_to_press(args.patient, args.cases, args.only, table.folder() / "what_if");
  for (std::size_t n = 0; n < breasts.size(); ++n)
    for (const std::string& view : args.views)
      add_what_if_rows({breasts[n], view, args.states},
                       [&](const nlohmann::json& row) { table.add(n, row); });
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-what-if",
      "Compares the reduced models behind the page's sliders with full solves in their range",
      declare, run);
}
