#include "tests/pipeline/chain_run.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <random>

#include "tests/file_text.h"
#include "tests/pipeline/faults/faults.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using Bytes = std::map<std::string, std::string>;
using Times = std::map<std::string, fs::file_time_type>;

/// `finished`: when each product with a sidecar was written; new ones are added.
void expect_nothing_half_written(const ChainRun& chain, const Bytes& expected, Times& finished) {
  const fs::path folder = chain.results / chain.patient;
  for (const auto& [name, bytes] : chain.products()) {
    if (name.front() == '.') continue;  // temporary
    EXPECT_TRUE(expected.count(name) && bytes == expected.at(name)) << name << " is half-written";
    if (!fs::exists(folder / (name + ".json"))) continue;
    const auto [before, is_new] = finished.emplace(name, fs::last_write_time(folder / name));
    EXPECT_EQ(before->second, fs::last_write_time(folder / name)) << name << " was made again";
  }
}

void expect_end(const ChainRun& chain, const Bytes& expected, Times& finished) {
  const CommandResult end = chain.run_script("run_patient.sh", "patient");
  EXPECT_EQ(end.exit_code, 0) << end.text;
  expect_nothing_half_written(chain, expected, finished);
  const Bytes found = chain.products();
  EXPECT_EQ(found.size(), expected.size());
  for (const auto& [name, bytes] : expected)
    EXPECT_TRUE(found.count(name)) << name << " is missing";
}

}  // namespace

std::vector<std::string> ChainRun::environment() const {
  return {"P=" + patient, "DATA=" + data.string(), "RESULTS=" + results.string(),
          "BIN=" MAMMOTWIN_BIN};
}

CommandResult ChainRun::run_script(const std::string& script, const std::string& target) const {
  std::vector<std::string> words{MAMMOTWIN_SOURCE_DIR "/pipeline/" + script};
  if (!target.empty()) words.push_back(target);
  return run_command(words, environment());
}

Bytes ChainRun::products() const {
  Bytes bytes;
  if (!fs::exists(results / patient)) return bytes;
  for (const auto& entry : fs::directory_iterator(results / patient))
    if (entry.is_regular_file() &&
        (entry.path().extension() != ".json" || entry.path().stem().extension() == ".mrk"))
      bytes[entry.path().filename().string()] = text_of(entry.path());
  return bytes;
}

std::string ChainRun::next_product() const {
  for (const char* product : {"segmentation.seg.nrrd", "prone.vtu", "unloaded.vtu", "cc.vtu",
                              "mlo.vtu", "lesions.csv", "report.html"})
    if (!fs::exists(results / patient / (std::string(product) + ".json"))) return product;
  return "nothing";
}

void expect_nothing_lost_to_kills(const ChainRun& chain, int kills, int most_a_chain,
                                  double interval_s, const Bytes& expected) {
  std::mt19937 random(1);
  std::map<std::string, int> killed_at;
  int done = 0, chains = 0;
  while (done < kills) {
    fs::remove_all(chain.results / chain.patient);
    Times finished;
    bool killed = true;
    for (int i = 0; killed && i < most_a_chain && done < kills; ++i) {
      const double moment = 2 * interval_s * static_cast<double>(random()) / std::mt19937::max();
      SCOPED_TRACE("killed after " + std::to_string(moment) + " s");
      killed =
          run_and_kill_after(moment, {MAMMOTWIN_SOURCE_DIR "/pipeline/run_patient.sh", "patient"},
                             chain.environment());
      done += killed;
      killed_at[chain.next_product()] += killed;
      expect_nothing_half_written(chain, expected, finished);
    }
    expect_end(chain, expected, finished);
    std::cerr << done << " kills in " << ++chains << " chains\n";
  }
  for (const auto& [product, times] : killed_at)
    std::cerr << "  " << times << " before " << product << "\n";
}

namespace {

constexpr const char* kStages[] = {"segment", "fit", "unload", "compress", "register", "report"};

/// A folder becomes a copy of another, or is no more where that is not there.
void copy_over(const fs::path& from, const fs::path& to) {
  fs::remove_all(to);
  if (fs::exists(from)) fs::copy(from, to, fs::copy_options::recursive);
}

/// A stage, what the stages before have left, and how many steps it takes in the results folder.
struct SteppedStage {
  std::string name;
  fs::path before;
  Bytes products;
  long steps = 0;
};

class SteppedChain {
 public:
  SteppedChain(const ChainRun& chain, const fs::path& scratch)
      : chain_(chain),
        folder_(chain.results / chain.patient),
        faults_(folder_, scratch, Faults::Keeps::nothing) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    for (const char* name : kStages) {
      SteppedStage& stage = stages_.emplace_back();
      stage.name = name;
      stage.before = scratch / name;
      copy_over(folder_, stage.before);
      EXPECT_EQ(run(stage, 0), 0);
      stage.steps = faults_.steps();
      stage.products = chain_.products();
    }
  }

  const std::vector<SteppedStage>& stages() const { return stages_; }

  void kill_and_go_on(const SteppedStage& stage, long step) {
    SCOPED_TRACE(stage.name + ", step " + std::to_string(step) + " of " +
                 std::to_string(stage.steps));
    copy_over(stage.before, folder_);
    EXPECT_EQ(run(stage, step), 137);
    for (const auto& [name, bytes] : chain_.products())
      EXPECT_TRUE(name.front() == '.' || bytes == stage.products.at(name)) << name;
    const CommandResult end = chain_.run_script("run_patient.sh", stage.name);
    EXPECT_EQ(end.exit_code, 0) << end.text;
    EXPECT_TRUE(chain_.products() == stage.products) << "other products than undisturbed";
  }

 private:
  int run(const SteppedStage& stage, long kill_at) {
    return faults_
        .run({MAMMOTWIN_SOURCE_DIR "/pipeline/run_patient.sh", stage.name}, chain_.environment(),
             kill_at)
        .exit_code;
  }

  ChainRun chain_;
  fs::path folder_;
  Faults faults_;
  std::vector<SteppedStage> stages_;
};

}  // namespace

void expect_nothing_lost_at_steps(const ChainRun& chain, int kills, const fs::path& scratch) {
  SteppedChain stepped(chain, scratch);
  long all = 0;
  for (const SteppedStage& stage : stepped.stages()) all += stage.steps;
  for (const SteppedStage& stage : stepped.stages()) {
    const long share = std::max(1L, kills * stage.steps / all);
    for (long n = 0; n < share; ++n)
      stepped.kill_and_go_on(stage, 1 + n * (stage.steps - 1) / std::max(1L, share - 1));
    std::cerr << "  " << share << " kills at steps of " << stage.name << ", which takes "
              << stage.steps << "\n";
  }
}

}  // namespace mammotwin
