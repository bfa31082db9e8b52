#pragma once

#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace mammotwin {

/// Shows runs as Google Benchmark does, and keeps them for a page of docs/measured.
class CaseReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) keep(run);
  }

  /// `{"cases": [...]}`, a case a run: `benchmark`, `threads` where they were set, `ms` of an
  /// iteration, of all threads [CPU ms], and the counters.
  void write(const std::filesystem::path& path) const {
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << nlohmann::json{{"cases", cases_}}.dump(1) << "\n";
  }

 private:
  void keep(const Run& run) {
    if (run.error_occurred || run.run_type != Run::RT_Iteration) return;
    const std::string arguments = run.run_name.args;  // "mesh/threads"
    const double iterations = static_cast<double>(run.iterations);
    nlohmann::json one{{"benchmark", run.run_name.function_name},
                       {"ms", 1e3 * run.cpu_accumulated_time / iterations}};
    if (const auto slash = arguments.find('/'); slash != std::string::npos)
      one["threads"] = std::stoi(arguments.substr(slash + 1));
    for (const auto& [name, counter] : run.counters) one[name] = counter.value;
    cases_.push_back(std::move(one));
  }

  nlohmann::json cases_ = nlohmann::json::array();
};

}  // namespace mammotwin
