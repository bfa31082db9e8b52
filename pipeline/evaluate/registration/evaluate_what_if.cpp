// evaluate-what-if: the reduced models that a page may carry against full solves in the sliders'
// range -> one table. Rows of breasts and views that a run is not asked for stay in it.

#include <algorithm>
#include <fstream>

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/cases/real_breasts.h"
#include "pipeline/evaluate/registration/what_if_rows.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path patient, cases, table;
  std::vector<std::string> only = {"042", "Exam_02-left", "Exam_11-right", "mimbcd_8af60052"};
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

bool is_run(const Arguments& args, const std::string& name, const std::string& view) {
  return is_asked(name, args.only) &&
         std::find(args.views.begin(), args.views.end(), view) != args.views.end();
}

std::vector<nlohmann::json> rows_to_keep(const Arguments& args) {
  std::vector<nlohmann::json> kept;
  if (!fs::exists(args.table)) return kept;
  const nlohmann::json table = nlohmann::json::parse(std::ifstream(args.table));
  for (const nlohmann::json& row : table.at("cases"))
    if (!is_run(args, row.at("name"), row.at("view"))) kept.push_back(row);
  return kept;
}

int run(const Arguments& args) {
  const std::vector<nlohmann::json> kept = rows_to_keep(args);
  EvaluationTable table(args.table);
  std::size_t number = 0;
  for (const nlohmann::json& row : kept) table.add(number++, row);
  for (const BreastToPress& breast :
       breasts_to_press(args.patient, args.cases, args.only, table.folder() / "what_if"))
    for (const std::string& view : args.views)
      if (is_run(args, breast.name, view))
        add_what_if_rows({breast, view, args.states},
                         [&](const nlohmann::json& row) { table.add(number++, row); });
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
