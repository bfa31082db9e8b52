// The cohort on a real Slurm: slurmctld, slurmd and munge on this machine (with_slurm.sh).

#include <filesystem>

#include "tests/pipeline/cohort/cohort_folder.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
constexpr int kSkipped = 77;

class SlurmCohort : public CohortFolderTest {
 protected:
  CommandResult run_under_slurm(const std::vector<std::string>& more) const {
    auto variables = environment(more);
    variables.push_back("ENGINE=slurm");
    return run_command(
        {MAMMOTWIN_SOURCE_DIR "/tests/pipeline/cohort/with_slurm.sh", (folder_ / "slurm").string(),
         MAMMOTWIN_SOURCE_DIR "/pipeline/cohort/run_cohort.sh"},
        variables);
  }
  std::string config(const std::string& more = "") const {
    return "CONFIG=" +
           write("conf", "memory_mb = 500\ncpus = 1\ntime = 00:05:00\n" + more).string();
  }
};

TEST_F(SlurmCohort, WritesTheTableThatOneMachineWrites) {
  add_patient("fine");
  add_patient("thin", "look fit");
  add_patient("cube", "refuse fit");
  add_patient("stiff", "diverge compress");
  add_patient("killed", "die register");
  run_cohort();
  const std::string table = text_of(results("cohort.tsv"));
  const std::string failed = text_of(results("failed.tsv"));
  fs::remove_all(results());

  // Arrays of at most 3 tasks, so that the five patients need two.
  const CommandResult run = run_under_slurm({"MAX_ARRAY_SIZE=4", config("partition = short\n")});
  if (run.exit_code == kSkipped) GTEST_SKIP() << run.text;
  EXPECT_EQ(run.exit_code, 1) << run.text;
  EXPECT_NE(run.text.find("5 patients as Slurm job arrays of at most 3"), std::string::npos)
      << run.text;
  EXPECT_EQ(text_of(results("cohort.tsv")), table) << run.text;
  EXPECT_EQ(text_of(results("failed.tsv")), failed);
}

TEST_F(SlurmCohort, SaysWhenSlurmTakesNoJobs) {
  add_patient("fine");
  const CommandResult run = run_under_slurm({config("partition = nowhere\n")});
  if (run.exit_code == kSkipped) GTEST_SKIP() << run.text;
  EXPECT_EQ(run.exit_code, 1) << run.text;
  EXPECT_NE(run.text.find("nowhere"), std::string::npos) << run.text;
  EXPECT_EQ(table("cohort.tsv")["fine"]["status"], "not_run");
}

}  // namespace
}  // namespace mammotwin
