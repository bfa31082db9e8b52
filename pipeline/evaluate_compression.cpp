// evaluate-compression: compresses a drawn population and patients' breasts, unattended -> one
// table.

#include <atomic>
#include <iostream>
#include <mutex>
#include <thread>

#include "pipeline/evaluate/breast_inputs.h"
#include "pipeline/evaluate/compression_row.h"
#include "pipeline/evaluate/compression_summary.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path table, cases;
  int synthetic = 200, first = 0, jobs = 1, most_cpu_seconds = 3600;
  std::string only;
  bool refit = false;
};

void declare(CommandLine& command, Arguments& args) {
  command
      .option("table", args.table,
              "compression.json to write; inputs and results of each breast go to the folder "
              "compression beside it")
      .required();
  command.option("--synthetic", args.synthetic, "breasts of the population, each in both views")
      .between(0, 10000)
      .with_default();
  command.option("--first", args.first, "the first of them").between(0, 10000).with_default();
  command.option("--cases", args.cases, "folder with label_maps/*.nii.gz (none: no patients)");
  command.option("--only", args.only, "breasts whose name contains this (text)");
  command.option("--jobs", args.jobs, "breasts at a time, each on all cores [1 to 64]")
      .between(1, 64)
      .with_default();
  command
      .option("--limit", args.most_cpu_seconds, "a compression is given up after this [s of CPU]")
      .between(1, 1000000)
      .with_default();
  command.flag("--refit", args.refit, "segment and fit again what lies there already");
}

std::vector<EvaluatedBreast> breasts_of(const Arguments& args) {
  std::vector<EvaluatedBreast> all;
  for (int n = args.first; n < args.first + args.synthetic; ++n) {
    const SyntheticBreast drawn = draw_breast(n);
    all.push_back({drawn.name, {}, drawn, {}});
  }
  for (const LabelMapBreast& breast : label_map_breasts(args.cases))
    all.push_back(
        {breast.exam + "-" + (breast.side == Side::left ? "left" : "right"), {}, {}, breast});
  std::erase_if(all, [&](const auto& b) { return b.name.find(args.only) == std::string::npos; });
  for (EvaluatedBreast& breast : all)
    breast.folder = fs::absolute(args.table).parent_path() / "compression" / breast.name;
  return all;
}

/// Rows of the breasts that are done, in the breasts' order, after each of them on disk.
class Table {
 public:
  Table(fs::path file, std::size_t breasts) : file_(std::move(file)), rows_(breasts) {}

  void add(std::size_t breast, nlohmann::json row) {
    const std::lock_guard lock(mutex_);
    std::cerr << line_of(row) << std::endl;
    rows_[breast].push_back(std::move(row));
    write_text_atomically(file_, nlohmann::json{{"cases", cases()}}.dump(1) + "\n");
  }
  nlohmann::json cases() const {
    nlohmann::json cases = nlohmann::json::array();
    for (const auto& rows : rows_)
      for (const auto& row : rows) cases.push_back(row);
    return cases;
  }

 private:
  fs::path file_;
  std::vector<std::vector<nlohmann::json>> rows_;
  std::mutex mutex_;
};

void evaluate(const Arguments& args, const EvaluatedBreast& breast, std::size_t index,
              Table& table) {
  const PreparedBreast prepared = prepare_breast(breast, args.refit);
  for (const AskedView& view : prepared.views)
    table.add(index, compression_row(breast, prepared, view, args.most_cpu_seconds));
}

int run(const Arguments& args) {
  const std::vector<EvaluatedBreast> breasts = breasts_of(args);
  if (breasts.empty()) throw std::runtime_error("no breast is asked for");
  fs::create_directories(fs::absolute(args.table).parent_path());
  Table table(args.table, breasts.size());
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> workers;
  for (int job = 0; job < args.jobs; ++job)
    workers.emplace_back([&] {
      for (std::size_t n; (n = next++) < breasts.size();) evaluate(args, breasts[n], n, table);
    });
  workers.clear();  // joins
  std::cerr << compression_summary(table.cases());
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
