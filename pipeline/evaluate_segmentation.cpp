// evaluate-segmentation: segments breasts whose truth is known -> one table.

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "pipeline/evaluate/segmentation_row.h"
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
  command.option("--only", args.only, "cases whose name contains one of these (texts)");
  command.option("--keep", args.keep, "folder for each case's image, true and found labels");
  command.option("--jobs", args.jobs, "cases at a time, about 1 GB each")
      .between(1, 64)
      .with_default();
}

std::vector<SegmentationCase> chosen_cases(const Arguments& args) {
  std::vector<SegmentationCase> cases = drawn_cases(args.synthetic);
  for (SegmentationCase& c : label_map_cases(args.cases)) cases.push_back(std::move(c));
  const auto is_wanted = [&](const SegmentationCase& c) {
    return std::any_of(args.only.begin(), args.only.end(), [&](const std::string& text) {
      return c.name.find(text) != std::string::npos;
    });
  };
  if (!args.only.empty()) std::erase_if(cases, [&](const auto& c) { return !is_wanted(c); });
  return cases;
}

/// Works through the cases with several threads; rows stand in the order of the cases.
nlohmann::json evaluate(const std::vector<SegmentationCase>& cases, const Arguments& args) {
  std::vector<nlohmann::json> rows(cases.size());
  std::atomic<std::size_t> next{0};
  std::mutex talk;
  std::vector<std::thread> workers;
  for (int job = 0; job < args.jobs; ++job)
    workers.emplace_back([&, job] {
      const auto image = args.table.parent_path() /
                         (args.table.stem().string() + "_mri_" + std::to_string(job) + ".nrrd");
      for (std::size_t n = next++; n < cases.size(); n = next++) {
        rows[n] = segmentation_row(cases[n], image, args.keep);
        const std::lock_guard lock(talk);
        std::cerr << rows[n].dump() << std::endl;
      }
    });
  for (std::thread& worker : workers) worker.join();
  return rows;
}

int run(const Arguments& args) {
  if (!args.table.parent_path().empty())
    std::filesystem::create_directories(args.table.parent_path());
  const nlohmann::json rows = evaluate(chosen_cases(args), args);
  std::ofstream(args.table) << nlohmann::json{{"cases", rows}}.dump(1) << "\n";
  std::cerr << segmentation_summary(rows);
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
