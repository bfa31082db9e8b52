// evaluate-stabilisation: breasts pressed with more and less of the term that keeps each point's
// volume -> one table.

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/compression/breast_stages.h"
#include "pipeline/evaluate/compression/stabilisation_rows.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path patient, cases, table;
  std::vector<std::string> only;
};

void declare(CommandLine& command, Arguments& args) {
  declare_patient(command, args.patient);
  declare_cases(command, args.cases);
  declare_table(command, args.table, "stabilisation");
  declare_only(command, args.only);
}

int run(const Arguments& args) {
  tabulate_breasts(args.patient, args.cases, args.only, args.table, add_stabilisation_rows);
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-stabilisation",
      "Presses breasts with more and less of the term that keeps each point's volume, and writes "
      "what it costs in force and millimetres",
      declare, run);
}
