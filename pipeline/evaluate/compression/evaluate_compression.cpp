// evaluate-compression: compresses a drawn population and patients' breasts, unattended -> one
// table.

#include <iostream>

#include "pipeline/evaluate/cases/breast_inputs.h"
#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/compression/compression_row.h"
#include "pipeline/evaluate/compression/compression_summary.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path table, cases;
  int synthetic = 200, first = 0, jobs = 1, most_cpu_seconds = 3600;
  std::vector<std::string> only, views;
  std::string preset = kDefaultTissue;
  bool unload = false, refit = false, keep = false;
};

void declare(CommandLine& command, Arguments& args) {
  command
      .option("table", args.table,
              "compression.json to write; inputs and results of each breast go to the folder "
              "compression beside it")
      .required();
  command.option("--synthetic", args.synthetic, "breasts of the population")
      .between(0, 10000)
      .with_default();
  command.option("--first", args.first, "the first of them").between(0, 10000).with_default();
  command.option("--cases", args.cases, "folder with label_maps/*.nii.gz (none: no patients)");
  declare_only(command, args.only);
  declare_views(command, args.views);
  declare_jobs(command, args.jobs, "breasts at a time, each on all cores");
  command
      .option("--limit", args.most_cpu_seconds, "a compression is given up after this [s of CPU]")
      .between(1, 1000000)
      .with_default();
  command.option("--preset", args.preset, "the tissue's materials.preset").with_default();
  declare_unloaded(command, args.unload);
  declare_keep(command, args.keep);
  command.flag("--refit", args.refit, "segment and fit again what lies there already");
}

std::vector<EvaluatedBreast> breasts_of(const Arguments& args) {
  std::vector<EvaluatedBreast> all;
  for (int n = args.first; n < args.first + args.synthetic; ++n) {
    const SyntheticBreast drawn = draw_breast(n);
    all.push_back({drawn.name, {}, drawn, {}, args.preset, args.unload});
  }
  for (const LabelMapBreast& breast : label_map_breasts(args.cases))
    all.push_back({breast.exam + "-" + (breast.side == Side::left ? "left" : "right"),
                   {},
                   {},
                   breast,
                   args.preset,
                   args.unload});
  std::erase_if(all, [&](const auto& breast) { return !is_asked(breast.name, args.only); });
  for (EvaluatedBreast& breast : all)
    breast.folder = fs::absolute(args.table).parent_path() / "compression" / breast.name;
  return all;
}

void evaluate(const Arguments& args, const EvaluatedBreast& breast, std::size_t index,
              EvaluationTable& table) {
  const PreparedBreast prepared = prepare_breast(breast, args.refit);
  for (const AskedView& view : prepared.views) {
    if (!is_asked(view.view, args.views)) continue;
    nlohmann::json row = compression_row(breast, prepared, view, args.most_cpu_seconds);
    const std::string line = line_of(row);
    table.add(index, std::move(row), line);
  }
}

int run(const Arguments& args) {
  const std::vector<EvaluatedBreast> breasts = breasts_of(args);
  if (breasts.empty()) throw std::runtime_error("no breast is asked for");
  EvaluationTable table(args.table, args.keep);
  work_through(breasts.size(), args.jobs,
               [&](std::size_t n) { evaluate(args, breasts[n], n, table); });
  std::cerr << compression_summary(table.rows());
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-compression",
      "Compresses synthetic breasts and patients' label maps, and writes how each ended", declare,
      run);
}
