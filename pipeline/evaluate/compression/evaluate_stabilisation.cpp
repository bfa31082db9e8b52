// evaluate-stabilisation: breasts pressed with more and less of the term that keeps each point's
// volume -> one table.

#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/cases/real_breasts.h"
#include "pipeline/evaluate/compression/stabilisation_rows.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"
#include "pipeline/synthesize/option_table.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path patient, cases, table;
  std::vector<std::string> only;
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
              "stabilisation.json to write; each breast's files go to the folder stabilisation "
              "beside it")
      .required();
  command.option("--only", args.only, "cases whose name contains one of these (texts)");
}

std::vector<StabilisedBreast> breasts_asked(const Arguments& args, const fs::path& folder) {
  const fs::path patient = fs::absolute(args.patient);
  const std::string first = patient.parent_path().filename();
  std::vector<StabilisedBreast> breasts{{first, patient, folder / first}};
  for (const RealBreast& real : real_breasts(args.cases)) {
    StabilisedBreast breast{name_and_side(real), {}, {}};
    if (!is_asked(breast.name, args.only)) continue;
    breast.folder = folder / breast.name;
    breast.patient_toml = breast.folder / "patient.toml";
    fs::create_directories(breast.folder);
    write_text_atomically(
        breast.patient_toml,
        real.patient_toml + "[views.cc]\nthickness_mm = 55\n[views.mlo]\nthickness_mm = 55\n");
    breasts.push_back(breast);
  }
  return breasts;
}

int run(const Arguments& args) {
  EvaluationTable table(args.table);
  const auto breasts = breasts_asked(args, table.folder() / "stabilisation");
  for (std::size_t n = 0; n < breasts.size(); ++n)
    add_stabilisation_rows(breasts[n], [&](const nlohmann::json& row) { table.add(n, row); });
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
