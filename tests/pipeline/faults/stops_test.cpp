// A run that is told to stop, two runs at once, a disk that turned read-only, a clock set back.

#include <signal.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <thread>

#include "tests/pipeline/faults/fake_stage_folder.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

class Stops : public FakeStageFolder {
 protected:
  std::future<CommandResult> start(const std::vector<std::string>& arguments,
                                   const std::vector<std::string>& environment = {}) const {
    return std::async(std::launch::async, run_command, arguments, environment);
  }
  bool has_partial_files() const {
    const auto names = hidden();
    return std::any_of(names.begin(), names.end(),
                       [](const std::string& name) { return name.starts_with(".partial-"); });
  }
  /// False where it does not come true within ten seconds.
  template <class Condition>
  static bool comes_true(Condition condition) {
    for (int n = 0; n < 1000; ++n) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
};

TEST_F(Stops, LeaveNeitherPartialFilesNorLocks) {
  behave("linger fit");
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const auto arguments = stage();
    std::vector<char*> argv;
    for (const std::string& word : arguments) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      for (const int each : {SIGINT, SIGTERM, SIGHUP}) signal(each, SIG_DFL);
      execv(argv[0], argv.data());
      _exit(127);
    }
    ASSERT_TRUE(comes_true([&] { return has_partial_files(); }));
    kill(child, number);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == number);
    EXPECT_EQ(hidden(), std::vector<std::string>());
    EXPECT_FALSE(fs::exists(product()));
  }
}

TEST_F(Stops, OfAScriptReachWhatItRuns) {
  for (const char* name : {"segment", "unload", "compress", "register", "report"})
    fs::create_symlink(MAMMOTWIN_BIN "/cohort_fake_stage",
                       folder_ / "bin" / ("mammotwin-" + std::string(name)));
  fs::create_directories(folder_ / "cohort");
  fs::rename(folder_ / "data", folder_ / "cohort" / "p");
  write("cohort/p/behaviour.txt", "linger segment\n");
  const fs::path results = folder_ / "results" / "p";
  const auto is_there = [&](const std::string& begin) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(results, none))
      if (entry.path().filename().string().starts_with(begin)) return true;
    return false;
  };
  for (const std::string script : {"cohort/run_cohort.sh", "run_patient.sh"}) {
    SCOPED_TRACE(script);
    const pid_t child = fork();
    if (child == 0) {
      setpgid(0, 0);
      for (const std::string& entry :
           {"P=" + std::string("p"), "DATA=" + (folder_ / "cohort").string(),
            "RESULTS=" + (folder_ / "results").string(), "BIN=" + (folder_ / "bin").string()})
        putenv(strdup(entry.c_str()));
      execl((MAMMOTWIN_SOURCE_DIR "/pipeline/" + script).c_str(), script.c_str(), "patient",
            nullptr);
      _exit(127);
    }
    ASSERT_TRUE(comes_true([&] { return is_there(".partial-"); }));
    const auto told = std::chrono::steady_clock::now();
    kill(child, SIGTERM);  // the script alone, as make, a service manager or a person does
    waitpid(child, nullptr, 0);
    EXPECT_TRUE(comes_true([&] { return !is_there("."); }));
    EXPECT_LT(std::chrono::steady_clock::now() - told, seconds(2)) << "it went on to its end";
    EXPECT_FALSE(is_there("segmentation")) << "and wrote";
  }
}

TEST_F(Stops, TwoRunsOfOneProductWaitForEachOther) {
  behave("linger fit");
  auto first = start(stage());
  ASSERT_TRUE(comes_true([&] { return has_partial_files(); }));
  const CommandResult second = run_command(stage());
  EXPECT_EQ(first.get().exit_code, 0);
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_NE(second.text.find("another run makes"), std::string::npos) << second.text;
  EXPECT_NE(second.text.find("is up to date"), std::string::npos) << second.text;
  EXPECT_EQ(hidden(), std::vector<std::string>());
}

// Killed between its sidecar and the removal of its checkpoint.
TEST_F(Stops, AFinishedProductLosesItsCheckpoint) {
  ASSERT_EQ(run_command(stage()).exit_code, 0);
  std::ofstream(product().parent_path() / ".prone.vtu.checkpoint") << "of a run that was killed";
  EXPECT_NE(run_command(stage()).text.find("is up to date"), std::string::npos);
  EXPECT_EQ(hidden(), std::vector<std::string>());
}

TEST_F(Stops, AClockSetBackMakesNothingOldOrNew) {
  ASSERT_EQ(run_command(stage()).exit_code, 0);
  const auto now = fs::file_time_type::clock::now();
  for (const auto years : {-30, 30})
    for (const fs::path& file : {folder_ / "a", product()}) {
      fs::last_write_time(file, now + years * std::chrono::hours(8760));
      EXPECT_NE(run_command(stage()).text.find("is up to date"), std::string::npos);
    }
}

TEST_F(Stops, AReadOnlyDiskKeepsItsProductAndIsNamed) {
  if (geteuid() != 0) GTEST_SKIP() << "mounting needs root";
  const std::string disk = (folder_ / "disk").string();
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=16m") != 0)
    GTEST_SKIP() << "a file system cannot be mounted here";
  const CommandResult made = run_command(stage());
  const std::string before = products();
  mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr);
  const CommandResult current = run_command(stage());
  write("a", "another input");
  const CommandResult refused = run_command(stage());
  const std::string after = products();
  umount2(disk.c_str(), MNT_DETACH);
  EXPECT_EQ(made.exit_code, 0);
  EXPECT_NE(current.text.find("is up to date"), std::string::npos) << current.text;
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.text.find("results folder cannot be written"), std::string::npos)
      << refused.text;
  EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace mammotwin
