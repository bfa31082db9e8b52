// evaluate-real-pairs: patients whose lesions somebody marked on their mammograms -> one table.

#include <algorithm>
#include <iostream>

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/cases/patient_chain.h"
#include "pipeline/evaluate/registration/real_pair_rows.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path cases, table;
  bool judge = false;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("cases", args.cases, "folder of patients' folders with patient.toml and marks.csv")
      .required()
      .existing_folder();
  declare_table(command, args.table, "real_pairs", "each patient's");
  command.flag("--judge", args.judge, "judge what lies there, without running a stage");
}

std::vector<fs::path> marked_patients(const fs::path& cases) {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(cases))
    if (fs::exists(entry.path() / "patient.toml") && fs::exists(entry.path() / "marks.csv"))
      folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  if (folders.empty())
    throw std::runtime_error(cases.string() +
                             ": no folder in it holds a patient.toml and a marks.csv "
                             "(pipeline/evaluate/README.md says what stands in that)");
  return folders;
}

json rows_of(const fs::path& patient, const fs::path& results, bool only_judge) {
  try {
    if (!only_judge) run_patient_chain(patient / "patient.toml", results);
    return real_pair_rows(patient, results);
  } catch (const std::exception& error) {
    return json::array({{{"case", patient.filename().string()}, {"reason", error.what()}}});
  }
}

int run(const Arguments& args) {
  EvaluationTable table(args.table);
  std::size_t patients = 0;
  for (const fs::path& patient : marked_patients(args.cases)) {
    const fs::path results = table.folder() / "real_pairs" / patient.filename();
    for (json& row : rows_of(patient, results, args.judge)) table.add(patients, std::move(row));
    ++patients;
  }
  std::cerr << real_pairs_summary(table.rows());
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-real-pairs",
      "Takes patients through the chain whose lesions somebody marked on their mammograms, and "
      "writes how far off the predictions are",
      declare, run);
}
