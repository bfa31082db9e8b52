// evaluate-tomosynthesis: patient 042 with tomosynthesis of another model -> slices of its lesions.

#include <iostream>

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/registration/registration_case.h"
#include "pipeline/evaluate/registration/tomosynthesis_rows.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/patient/tissue_presets.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path table;
  bool coarse = false;
};

void declare(CommandLine& command, Arguments& args) {
  declare_table(command, args.table, "tomosynthesis", "the patient's");
  command.flag("--coarse", args.coarse,
               "few elements in the truth and in the model: to try it out");
}

int run(const Arguments& args) {
  EvaluationTable table(args.table);
  const std::filesystem::path folder = table.folder() / "tomosynthesis";
  make_tomosynthesis_case(args.coarse, folder);
  take_tissue(kDefaultTissue, folder);
  run_registration_case(folder);
  for (nlohmann::json row : tomosynthesis_rows(folder)) table.add(0, std::move(row));
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(argc, argv, "evaluate-tomosynthesis",
                                      "Registers patient 042 with tomosynthesis made by another "
                                      "model, and writes in which slices its lesions are found",
                                      declare, run);
}
