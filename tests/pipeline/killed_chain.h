#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "tests/pipeline/chain_run.h"
#include "tests/pipeline/faults/faults.h"

namespace mammotwin {

/// Kills the stages of a patient's chain and goes on with what the kill has left, so that every
/// kill of a stage but the first hits a run that itself goes on from one. After each, nothing may
/// be half-written; at the end of a stage all products must be those of an undisturbed chain, byte
/// for byte, nothing else may be there, and nothing that was finished may have been made again.
class KilledChain {
 public:
  /// Runs the chain undisturbed, in an empty results folder, and keeps what each stage found there.
  /// `scratch`: for what this needs; `name`: the patient's in the rows for docs/measured
  /// (shown_rows.h), written after each kill. The quickest stage comes first.
  KilledChain(ChainRun chain, std::filesystem::path scratch, std::string name);

  /// Each stage is killed before the first step that it takes in the results folder (a file opened,
  /// written, closed, renamed or removed, an fsync: fault_layer.cpp), begun again and killed before
  /// the second, and so on until it comes to its end. Where a stage takes more than `most` steps,
  /// only every n-th of its writes counts.
  void kill_at_steps(long most);

  /// Each stage is killed `kills` times after times drawn evenly from 0 to what it takes.
  void kill_at_moments(int kills);

 private:
  struct Stage {
    std::string name;
    FolderSteps steps;
    double seconds = 0;
    long every_write = 1;
    int at_steps = 0, at_moments = 0, lost = 0;
    bool ended = true;  ///< after the last kill: what it holds has been compared
    std::map<std::string, std::string> products;  ///< all that are there when it has ended
  };

  std::filesystem::path before(const Stage& stage) const;
  std::vector<std::string> environment(const Stage& stage) const;
  std::vector<std::string> command(const Stage& stage) const;
  int run(const Stage& stage, long kill_at);
  void begin(const Stage& stage);
  void look_after_kill(Stage& stage);
  void end(Stage& stage, int exit_code);
  void expect_nothing_half_written(Stage& stage);
  void lose(Stage& stage, const std::string& what) const;
  /// A row a stage and one of all: steps, how often they were killed, what was lost.
  nlohmann::json rows() const;

  ChainRun chain_;
  std::string name_;
  std::filesystem::path folder_, scratch_;
  Faults faults_;
  std::vector<Stage> stages_;
  std::map<std::string, std::filesystem::file_time_type> finished_;  ///< products with a sidecar
  std::mt19937 random_{1};
};

/// Kills of each of the six stages, so that there are at least `kills` in all.
constexpr int per_stage(int kills) { return (kills + 5) / 6; }

}  // namespace mammotwin
