// evaluate-segmentation: segments breasts whose truth is known -> one table.

#include <iostream>

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/segmentation/segmentation_row.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path table, cases, keep;
  std::vector<std::string> only;
  int synthetic = 20, jobs = 1;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("table", args.table, "segmentation.json to write").required();
  command.option("--synthetic", args.synthetic, "synthetic patients, each of another seed")
      .between(0, 1000)
      .with_default();
  command.option("--cases", args.cases,
                 "folder with label_maps/*_labels.nii.gz: MRI is simulated from them, too");
  declare_only(command, args.only);
  command.option("--keep", args.keep, "folder for each case's image, true and found labels");
  declare_jobs(command, args.jobs, "cases at a time, about 1 GB each");
}

std::vector<SegmentationCase> chosen_cases(const Arguments& args) {
  std::vector<SegmentationCase> cases = drawn_cases(args.synthetic);
  for (SegmentationCase& c : label_map_cases(args.cases)) cases.push_back(std::move(c));
  for (SegmentationCase& c : varied_cases(args.cases)) cases.push_back(std::move(c));
  std::erase_if(cases, [&](const auto& c) { return !is_asked(c.name, args.only); });
  return cases;
}

int run(const Arguments& args) {
  const std::vector<SegmentationCase> cases = chosen_cases(args);
  EvaluationTable table(args.table);
  const std::string stem = args.table.stem().string();
  work_through(cases.size(), args.jobs, [&](std::size_t n) {
    const auto image = table.folder() / (stem + "_mri_" + std::to_string(n) + ".nrrd");
    table.add(n, segmentation_row(cases[n], image, args.keep));
  });
  std::cerr << segmentation_summary(table.rows());
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(argc, argv, "evaluate-segmentation",
                                      "segments breasts whose truth is known and writes one table",
                                      declare, run);
}
