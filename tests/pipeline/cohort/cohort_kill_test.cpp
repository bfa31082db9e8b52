// A run that is killed at a random moment loses nothing that was finished and leaves nothing
// half-written; the next run gives what an undisturbed one gives.

#include <sys/mount.h>

#include <chrono>
#include <random>

#include "tests/pipeline/cohort/cohort_folder.h"
#include "tests/pipeline/kills.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class KilledRun : public CohortFolderTest {
 protected:
  KilledRun() { add_patient("p"); }

  /// Names and bytes of all files in a results folder but the sidecars, which hold times.
  std::map<std::string, std::string> products() const {
    std::map<std::string, std::string> bytes;
    if (!fs::exists(results("p"))) return bytes;
    for (const auto& entry : fs::directory_iterator(results("p")))
      if (entry.is_regular_file() &&
          (entry.path().extension() != ".json" || entry.path().stem().extension() == ".mrk"))
        bytes[entry.path().filename().string()] = text_of(entry.path());
    return bytes;
  }

  static bool is_partial(const std::string& name) { return name.rfind(".partial-", 0) == 0; }

  /// Held by nobody once its run is dead; the next run of the stage takes it and removes it.
  static bool is_lock(const std::string& name) { return fs::path(name).extension() == ".lock"; }
};

TEST_F(KilledRun, LosesNothingAndLeavesNothingHalfWritten) {
  const auto start = Clock::now();
  run_patient("p");
  const double whole = std::chrono::duration<double>(Clock::now() - start).count();
  const auto expected = products();
  ASSERT_EQ(expected.size(), 11u);
  std::mt19937 random(1);
  for (int i = 0; i < num_kills(); ++i) {
    fs::remove_all(results("p"));
    const double moment = whole * static_cast<double>(random()) / std::mt19937::max();
    run_and_kill_after(moment, {MAMMOTWIN_SOURCE_DIR "/pipeline/run_patient.sh", "patient"},
                       environment({"P=p"}));
    std::map<std::string, fs::file_time_type> finished;
    for (const auto& [name, bytes] : products()) {
      if (is_partial(name) || is_lock(name)) continue;
      EXPECT_EQ(bytes, expected.at(name)) << name << " after " << moment << " s";
      const fs::path sidecar = results("p/" + name + ".json");
      if (fs::exists(sidecar)) finished[name] = fs::last_write_time(results("p/" + name));
    }
    run_patient("p");
    EXPECT_EQ(products(), expected) << "killed after " << moment << " s";
    EXPECT_EQ(verify("p").exit_code, 0) << verify("p").text;
    for (const auto& [name, time] : finished)
      EXPECT_EQ(fs::last_write_time(results("p/" + name)), time) << name << " was made again";
  }
}

/// A results folder of a few MiB that fills up.
class FullDisk : public KilledRun {
 protected:
  void SetUp() override {
    fs::create_directories(results());
    is_mounted_ = mount("tmpfs", results().c_str(), "tmpfs", 0, ("size=" + size_).c_str()) == 0;
    if (!is_mounted_) GTEST_SKIP() << "mounting a small tmpfs needs root";
  }
  void TearDown() override {
    if (is_mounted_) umount(results().c_str());
  }
  const std::string size_ = "1m";  // the fake chain writes ten products of 256 KiB
  bool is_mounted_ = false;
};

TEST_F(FullDisk, EndsWithAMessageAndNothingHalfWritten) {
  const CommandResult run = run_patient("p");
  EXPECT_EQ(run.exit_code, 1) << run.text;
  EXPECT_NE(run.text.find("cannot be written: No space left on device"), std::string::npos)
      << run.text;
  for (const auto& [name, bytes] : products()) EXPECT_FALSE(is_partial(name)) << name;
  EXPECT_EQ(verify("p").exit_code, 0) << verify("p").text;
}

TEST_F(FullDisk, IsNoFailureThatStands) {
  EXPECT_EQ(run_patient("p").exit_code, 1);
  ASSERT_EQ(mount("tmpfs", results().c_str(), "tmpfs", MS_REMOUNT, "size=16m"), 0);
  const CommandResult again = run_patient("p");
  EXPECT_EQ(again.exit_code, 0) << again.text;
}

}  // namespace
}  // namespace mammotwin
