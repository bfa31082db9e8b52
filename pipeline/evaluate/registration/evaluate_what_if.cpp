// evaluate-what-if: the reduced models that a page may carry against full solves in the sliders'
// range -> one table.

#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/cases/real_breasts.h"
#include "pipeline/evaluate/registration/what_if_rows.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path patient, cases, table;
  std::vector<std::string> only = {"Exam_02-left", "Exam_11-right", "mimbcd_6e4da81a"};
  std::string view = "cc";
  int states = 6;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("patient", args.patient, "patient.toml of a first breast")
      .required()
      .existing_file();
  command.option("cases", args.cases, "folder of real cases, as of evaluate-fitting")
      .required()
      .existing_folder();
  command
      .option("table", args.table,
              "what_if.json to write; each breast's files go to the folder what_if beside it")
      .required();
  command.option("--only", args.only, "cases whose name contains one of these (texts)");
  command.option("--view", args.view, "the view to press").one_of({"cc", "mlo"});
  command.option("--states", args.states, "pressed in full, of each breast");
}

std::vector<WhatIfCase> cases_asked(const Arguments& args, const fs::path& folder) {
  const fs::path patient = fs::absolute(args.patient);
  const std::string first = patient.parent_path().filename();
  std::vector<WhatIfCase> asked{{first, patient, folder / first, args.view, args.states}};
  for (const RealBreast& real : real_breasts(args.cases)) {
    const std::string name = name_and_side(real);
    if (!is_asked(name, args.only)) continue;
    const fs::path toml = folder / name / "patient.toml";
    fs::create_directories(toml.parent_path());
    write_text_atomically(toml,
                          real.patient_toml + "[views." + args.view + "]\nthickness_mm = 55\n");
    asked.push_back({name, toml, folder / name, args.view, args.states});
  }
  return asked;
}

int run(const Arguments& args) {
  EvaluationTable table(args.table);
  const auto cases = cases_asked(args, table.folder() / "what_if");
  for (std::size_t n = 0; n < cases.size(); ++n)
    add_what_if_rows(cases[n], [&](const nlohmann::json& row) { table.add(n, row); });
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
