// A compression that is killed at a random moment goes on from its last load step, and its product
// is the same as that of an undisturbed one, bit for bit.

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "fitting/mesh/mesh_file.h"
#include "segmentation/segmentation_file.h"
#include "tests/pipeline/command.h"
#include "tests/pipeline/kills.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/solver/dome_breast.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class InterruptedCompression : public ScratchFolder {
 protected:
  void SetUp() override {
    write_mesh_file(folder_ / "prone.vtu", dome_breast({3, 3, 1}));
    Segmentation all_fat;
    all_fat.labels = Volume<std::uint8_t>({40, 40, 40}, {4, 4, 4}, {-80, -80, -80}, label::fat);
    all_fat.fractions = all_fat.labels.like<Fractions>({1, 0, 0});
    all_fat.region = {Side::left, -70, 70, -70, 70};
    write_segmentation(folder_ / "segmentation.seg.nrrd", all_fat);
    write_fractions(folder_ / "fractions.nrrd", all_fat.fractions);
    write(
        "patient.toml",
        "side = \"left\"\n[compress]\nfriction_coefficient = 0.1\n[views.cc]\nthickness_mm = 80\n");
  }
  std::vector<std::string> command() const {
    const auto file = [&](const char* name) { return (folder_ / name).string(); };
    return {MAMMOTWIN_BIN "/mammotwin-compress",
            "cc",
            file("segmentation.seg.nrrd"),
            file("fractions.nrrd"),
            file("prone.vtu"),
            file("cc.vtu"),
            "--patient",
            file("patient.toml")};
  }
  bool ended(pid_t child) const { return waitpid(child, nullptr, WNOHANG) == child; }
  /// `seconds` after it began, or after it kept its first load step.
  void start_and_kill_after(double seconds, bool of_the_first_step) const {
    const std::vector<std::string> words = command();
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, 2);
      execv(argv[0], argv.data());
      _exit(127);
    }
    while (of_the_first_step && !fs::exists(folder_ / ".cc.vtu.checkpoint")) {
      if (ended(child)) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  nlohmann::json quality() const {
    return nlohmann::json::parse(text_of(folder_ / "cc.vtu.json")).at("quality");
  }
  bool leaves_nothing_behind() const {
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename().string().starts_with(".")) return false;
    return true;
  }
};

TEST_F(InterruptedCompression, GivesTheSameBitForBitWhenItIsRunAgain) {
  const auto start = Clock::now();
  const CommandResult whole = run_command(command());
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  ASSERT_EQ(whole.exit_code, 0) << whole.text;
  const std::string product = text_of(folder_ / "cc.vtu");
  const nlohmann::json figures = quality();
  std::mt19937 random(1);
  int resumed = 0;
  for (int i = 0; i < num_kills(); ++i) {
    fs::remove(folder_ / "cc.vtu");
    const bool of_the_first_step = i % 2 == 0;
    const double moment =
        i == 0 ? 0 : seconds * static_cast<double>(random()) / std::mt19937::max();
    start_and_kill_after(moment, of_the_first_step);
    const CommandResult again = run_command(command());
    resumed += again.text.find("goes on where") != std::string::npos;
    EXPECT_EQ(again.exit_code, 0) << again.text;
    EXPECT_EQ(text_of(folder_ / "cc.vtu"), product) << "killed after " << moment << " s";
    EXPECT_EQ(quality(), figures) << "killed after " << moment << " s";
    EXPECT_TRUE(leaves_nothing_behind()) << "killed after " << moment << " s";
  }
  EXPECT_GT(resumed, 0);
}

// Killed after its product, the same as before, and before its sidecar: the old one still holds.
TEST_F(InterruptedCompression, AnUpToDateRunTakesAwayWhatAKilledOneLeft) {
  ASSERT_EQ(run_command(command()).exit_code, 0);
  write(".partial-99999999-cc.vtu.json-0123456789abcdef", "half");
  write(".partial-99999999-cc.vtu-0123456789abcdef", "half");
  const CommandResult again = run_command(command());
  EXPECT_NE(again.text.find("is up to date"), std::string::npos) << again.text;
  EXPECT_TRUE(leaves_nothing_behind());
}

TEST_F(InterruptedCompression, BeginsAnewWhereTheCheckpointIsDamaged) {
  write(".cc.vtu.checkpoint", "damaged");
  const CommandResult run = run_command(command());
  EXPECT_EQ(run.exit_code, 0) << run.text;
  EXPECT_EQ(run.text.find("goes on where"), std::string::npos) << run.text;
  EXPECT_TRUE(leaves_nothing_behind());
}

}  // namespace
}  // namespace mammotwin
