#include "tests/pipeline/killed_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>

#include "tests/pipeline/shown_rows.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kStages[] = {"segment", "fit", "unload", "compress", "register", "report"};

void copy_over(const fs::path& from, const fs::path& to) {
  fs::remove_all(to);
  fs::copy(from, to, fs::copy_options::recursive);
}

/// Of the programs only a stage's own: what was finished before it is not looked at again.
void link_programs(const fs::path& bin, const std::string& stage) {
  fs::create_directories(bin);
  for (const char* name : kStages)
    fs::create_symlink(name == stage ? MAMMOTWIN_BIN "/mammotwin-" + stage : "/bin/true",
                       bin / ("mammotwin-" + std::string(name)));
}

/// When each product that has its sidecar was written.
std::map<std::string, fs::file_time_type> finished_in(const fs::path& folder) {
  std::map<std::string, fs::file_time_type> times;
  for (const auto& entry : fs::directory_iterator(folder))
    if (fs::exists(entry.path().string() + ".json"))
      times[entry.path().filename().string()] = fs::last_write_time(entry.path());
  return times;
}

bool is_whole_json(const fs::path& path) {
  std::ifstream in(path);
  return nlohmann::json::accept(in);
}

}  // namespace

KilledChain::KilledChain(ChainRun chain, fs::path scratch, std::string name)
    : chain_(std::move(chain)),
      name_(std::move(name)),
      folder_(chain_.results / chain_.patient),
      scratch_(std::move(scratch)),
      faults_(folder_, scratch_, Faults::Keeps::nothing) {
  fs::remove_all(folder_);
  fs::create_directories(folder_);
  for (const char* stage_name : kStages) {
    Stage& stage = stages_.emplace_back();
    stage.name = stage_name;
    link_programs(scratch_ / ("bin-" + stage.name), stage.name);
    copy_over(folder_, before(stage));
    const auto start = Clock::now();
    EXPECT_EQ(run(stage, 0), 0) << stage.name;
    stage.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    stage.steps = faults_.steps();
    stage.products = chain_.products();
  }
  std::sort(stages_.begin(), stages_.end(),
            [](const Stage& a, const Stage& b) { return a.seconds < b.seconds; });
}

void KilledChain::kill_at_steps(long most) {
  for (Stage& stage : stages_) {
    const long others = stage.steps.all - stage.steps.writes;
    const long counted = std::max(1L, most - others);
    stage.every_write = std::max(1L, (stage.steps.writes + counted - 1) / counted);
    begin(stage);
    int exit_code = 0;
    for (long step = 1; (exit_code = run(stage, step)) == 137; ++step) {
      ++stage.at_steps;
      SCOPED_TRACE("killed at step " + std::to_string(step));
      look_after_kill(stage);
    }
    end(stage, exit_code);
  }
}

void KilledChain::kill_at_moments(int kills) {
  for (Stage& stage : stages_) {
    begin(stage);
    while (stage.at_moments < kills) {
      const double moment = stage.seconds * static_cast<double>(random_()) / std::mt19937::max();
      SCOPED_TRACE("killed after " + std::to_string(moment) + " s");
      const bool killed = run_and_kill_after(moment, command(stage), environment(stage));
      stage.at_moments += killed;
      look_after_kill(stage);
      if (!killed) begin(stage);  // it had come to its end
    }
    end(stage, run(stage, 0));
  }
}

nlohmann::json KilledChain::rows() const {
  Stage all;
  all.name = "all";
  nlohmann::json rows = nlohmann::json::array();
  const auto add = [&](const Stage& stage) {
    rows.push_back({{"patient", name_},
                    {"stage", stage.name},
                    {"steps", stage.steps.all},
                    {"writes", stage.steps.writes},
                    {"kills_at_steps", stage.at_steps},
                    {"kills_at_moments", stage.at_moments},
                    {"kills", stage.at_steps + stage.at_moments},
                    {"lost", stage.lost},
                    {"ended", stage.ended}});
  };
  for (const Stage& stage : stages_) {
    add(stage);
    all.steps.all += stage.steps.all, all.steps.writes += stage.steps.writes;
    all.at_steps += stage.at_steps, all.at_moments += stage.at_moments, all.lost += stage.lost;
    all.ended &= stage.ended;
  }
  add(all);
  return rows;
}

fs::path KilledChain::before(const Stage& stage) const {
  return scratch_ / ("before-" + stage.name);
}

std::vector<std::string> KilledChain::environment(const Stage& stage) const {
  std::vector<std::string> entries = chain_.environment();
  entries.push_back("BIN=" + (scratch_ / ("bin-" + stage.name)).string());
  return entries;
}

std::vector<std::string> KilledChain::command(const Stage& stage) const {
  return {MAMMOTWIN_SOURCE_DIR "/pipeline/run_patient.sh", stage.name};
}

int KilledChain::run(const Stage& stage, long kill_at) {
  return faults_.run(command(stage), environment(stage), kill_at, stage.every_write).exit_code;
}

void KilledChain::begin(const Stage& stage) {
  copy_over(before(stage), folder_);
  finished_ = finished_in(folder_);
}

void KilledChain::look_after_kill(Stage& stage) {
  stage.ended = false;
  expect_nothing_half_written(stage);
  show_rows("kills", "patient", rows());
}

void KilledChain::end(Stage& stage, int exit_code) {
  stage.ended = true;
  if (exit_code != 0) lose(stage, "ended with exit code " + std::to_string(exit_code));
  expect_nothing_half_written(stage);
  const auto found = chain_.products();
  for (const auto& [name, bytes] : stage.products)
    if (!found.count(name)) lose(stage, name + " is missing");
  for (const auto& entry : fs::directory_iterator(folder_))
    if (const std::string name = entry.path().filename().string(); name.front() == '.')
      lose(stage, name + " was left");
  std::cerr << stage.name << ": killed at " << stage.at_steps << " steps and " << stage.at_moments
            << " moments\n";
  show_rows("kills", "patient", rows());
}

void KilledChain::expect_nothing_half_written(Stage& stage) {
  for (const auto& [name, bytes] : chain_.products())
    if (name.front() != '.' && (!stage.products.count(name) || bytes != stage.products.at(name)))
      lose(stage, name + " is half-written");
  for (const auto& entry : fs::directory_iterator(folder_))
    if (entry.path().extension() == ".json" && entry.path().filename().string().front() != '.' &&
        !is_whole_json(entry.path()))
      lose(stage, entry.path().filename().string() + " is half-written");
  const auto now = finished_in(folder_);
  for (const auto& [name, time] : finished_)
    if (!now.count(name) || now.at(name) != time) lose(stage, name + " was made again");
  finished_.insert(now.begin(), now.end());
}

void KilledChain::lose(Stage& stage, const std::string& what) const {
  ++stage.lost;
  ADD_FAILURE() << stage.name << ": " << what;
}

}  // namespace mammotwin
