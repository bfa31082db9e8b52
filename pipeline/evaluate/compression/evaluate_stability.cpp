// evaluate-stability: the same breast with its input changed in ways that must not matter -> one
// table.

#include <algorithm>

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/compression/stability_rows.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path cases, table;
  std::vector<std::string> only, changes, views;
  std::string other_preset;
  int jobs = 2;
  bool unload = false, keep = false;
};

void declare(CommandLine& command, Arguments& args) {
  declare_cases(command, args.cases);
  declare_table(command, args.table, "stability");
  declare_only(command, args.only);
  command.option("--changes", args.changes,
                 "turn_1, turn_3, turn_5, mirror, half_voxel, elements, thickness (default: all)");
  command.option("--other-preset", args.other_preset,
                 "instead: with the tissue of this materials.preset, a change that does matter");
  declare_views(command, args.views);
  declare_unloaded(command, args.unload);
  declare_keep(command, args.keep);
  declare_jobs(command, args.jobs);
}

std::vector<InputChange> changes_asked(const Arguments& args) {
  if (!args.other_preset.empty()) {
    if (!args.changes.empty())
      throw std::runtime_error("--changes and --other-preset are both given; expected one of them");
    return {{.name = args.other_preset, .preset = args.other_preset}};
  }
  std::vector<InputChange> changes = input_changes();
  for (const std::string& name : args.changes)
    if (std::none_of(changes.begin(), changes.end(), [&](auto& c) { return c.name == name; }))
      throw std::runtime_error("--changes: " + name + " is none of those that the help names");
  if (!args.changes.empty())
    std::erase_if(changes, [&](const auto& c) {
      return std::find(args.changes.begin(), args.changes.end(), c.name) == args.changes.end();
    });
  return changes;
}

int run(const Arguments& args) {
  EvaluationTable table(args.table, args.keep);
  std::vector<StabilityCase> asked;
  for (const RealBreast& breast : asked_breasts(args.cases, args.only)) {
    asked.push_back(
        {breast, table.folder() / "stability" / name_and_side(breast), changes_asked(args)});
    if (!args.views.empty()) asked.back().views = args.views;
    asked.back().unload = args.unload;
  }
  work_through(asked.size(), args.jobs, [&](std::size_t n) {
    add_stability_rows(asked[n], [&](const nlohmann::json& row) { table.add(n, row); });
  });
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(argc, argv, "evaluate-stability",
                                      "Presses label maps and patients' MRI again with their input "
                                      "changed in ways that must not matter, and writes "
                                      "how far tissue moves",
                                      declare, run);
}
