// evaluate-segmentation-changes: patients' MRI, changed in ways that must not matter -> what moves.

#include <algorithm>
#include <iostream>

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/cases/real_breasts.h"
#include "pipeline/evaluate/segmentation/segmentation_change_rows.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path cases, table;
  std::vector<std::string> only, changes;
  int jobs = 1;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("cases", args.cases, "folder of patients' folders with patient.toml")
      .required()
      .existing_folder();
  declare_table(command, args.table, "segmentation_changes");
  declare_only(command, args.only);
  command.option("--changes", args.changes, "those whose names are given (default: all)");
  declare_jobs(command, args.jobs, "breasts at a time, about 2 GB each");
}

std::vector<MriChange> changes_asked(const Arguments& args) {
  std::vector<MriChange> changes = mri_changes();
  const auto asked = [&](const MriChange& change) {
    return std::find(args.changes.begin(), args.changes.end(), change.name) != args.changes.end();
  };
  if (!args.changes.empty()) std::erase_if(changes, [&](const auto& c) { return !asked(c); });
  if (changes.size() < args.changes.size())
    throw std::runtime_error("--changes: there is no such change among those of mri_changes.h");
  return changes;
}

std::vector<SegmentationChangeCase> cases_asked(const Arguments& args, const fs::path& results) {
  std::vector<SegmentationChangeCase> cases;
  for (const auto& entry : fs::directory_iterator(args.cases)) {
    const std::string name = entry.path().filename().string();
    if (fs::exists(entry.path() / "patient.toml") && is_asked(name, args.only))
      cases.push_back({name, entry.path() / "patient.toml", results / name, changes_asked(args)});
  }
  std::sort(cases.begin(), cases.end(), [](auto& a, auto& b) { return a.name < b.name; });
  if (cases.empty())
    throw std::runtime_error(args.cases.string() + ": no such folder in it with a patient.toml");
  return cases;
}

int run(const Arguments& args) {
  EvaluationTable table(args.table);
  const auto cases = cases_asked(args, table.folder() / args.table.stem());
  work_through(cases.size(), args.jobs, [&](std::size_t n) {
    add_segmentation_change_rows(cases[n], [&](const nlohmann::json& row) { table.add(n, row); });
  });
  std::cerr << segmentation_changes_summary(table.rows());
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-segmentation-changes",
      "Segments patients' MRI again, changed in ways that must not matter, and writes how far "
      "what is found moves",
      declare, run);
}
