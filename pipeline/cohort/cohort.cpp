// mammotwin-cohort: results of many patients -> cohort.tsv, lesions.tsv, failed.tsv,
// cohort_times.tsv, cohort.html.

#include <fstream>
#include <iostream>
#include <optional>
#include <set>

#include "pipeline/cohort/lesions.h"
#include "pipeline/cohort/page.h"
#include "pipeline/cohort/patient_summary.h"
#include "pipeline/cohort/tables.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
constexpr int kBadData = 1;

struct Arguments {
  fs::path results;
  std::optional<fs::path> patients;
  RunAgain again;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("results", args.results, "folder of patients' results; the tables go there, too")
      .required();
  command.option("--patients", args.patients,
                 "file of patients' names, one a line, that are listed even without results");
  command.option("--front-door", args.again.front_door, "what commands that run again begin with")
      .with_default();
}

bool is_patient(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  return entry.is_directory() && name.front() != '.' && !read_stage_results(entry.path()).empty() &&
         name != "evaluation" && name.rfind("gel_", 0) != 0;
}

/// Those named and those with results, in the order of their names.
std::set<std::string> patients_of(const Arguments& args) {
  std::set<std::string> patients;
  if (args.patients) {
    std::ifstream in(*args.patients);
    if (!in) throw std::runtime_error(args.patients->string() + ": cannot be read");
    for (std::string name; std::getline(in, name);)
      if (!name.empty()) patients.insert(name);
  }
  for (const auto& entry : fs::directory_iterator(args.results))
    if (is_patient(entry)) patients.insert(entry.path().filename().string());
  return patients;
}

std::vector<PatientSummary> summarize(const Arguments& args) {
  const CohortFolder folder{args.results};
  std::vector<PatientSummary> cohort;
  for (const std::string& patient : patients_of(args))
    cohort.push_back(summarize_patient(folder, patient));
  return cohort;
}

int run(const Arguments& args) {
  const std::vector<PatientSummary> cohort = summarize(args);
  const Table failed = failed_table(cohort, args.again);
  write_text_atomically(args.results / "cohort.tsv", cohort_table(cohort).text());
  std::vector<std::string> left_out;
  write_text_atomically(args.results / "lesions.tsv",
                        lesions_table(args.results, cohort, left_out).text());
  for (const std::string& patient : left_out)
    std::cerr
        << "cohort: " << patient
        << ": not in lesions.tsv, for the columns of its lesions.csv are others; run register "
           "of it again\n";
  write_text_atomically(args.results / "cohort_times.tsv", times_table(cohort).text());
  write_text_atomically(args.results / "failed.tsv", failed.text());
  write_text_atomically(args.results / "cohort.html", cohort_page(cohort, args.again));
  std::cerr << "cohort: " << cohort.size() << " patients, " << failed.rows.size()
            << " failed: " << (args.results / "cohort.html").string() << "\n";
  for (const auto& row : failed.rows)
    std::cerr << "cohort: " << row[0] << ": " << row[1] << " at " << row[2] << ": " << row[3]
              << "\n";
  return failed.rows.empty() ? 0 : kBadData;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "cohort",
      "gathers the results of many patients into cohort.tsv, lesions.tsv, failed.tsv, "
      "cohort_times.tsv and cohort.html. Exit code 1 if a patient failed.",
      declare, run);
}
