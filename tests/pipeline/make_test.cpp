#include "tests/pipeline/command.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

/// The part of `make patient` that reads P, DATA and RESULTS, without building first.
class RunPatientTest : public ScratchFolder {
 protected:
  CommandResult run(const std::string& patient) {
    return run_command({MAMMOTWIN_SOURCE_DIR "/pipeline/run_patient.sh", "patient"},
                       {"P=" + patient, "DATA=" + folder_.string(),
                        "RESULTS=" + (folder_ / "results").string(), "BIN=" MAMMOTWIN_BIN});
  }
};

TEST_F(RunPatientTest, RefusesWhatIsNotAPlainName) {
  const std::string mark = (folder_ / "mark").string();
  for (const std::string& name :
       {std::string("../042"), std::string("a/b"), std::string(".hidden"), std::string("-x"),
        "a;touch " + mark, "$(touch " + mark + ")", "`touch " + mark + "`", std::string("a b"),
        std::string("a\nb")}) {
    const CommandResult result = run(name);
    EXPECT_EQ(result.exit_code, 2) << name;
    EXPECT_NE(result.text.find("not a plain name"), std::string::npos) << name << result.text;
  }
  EXPECT_FALSE(std::filesystem::exists(mark));
}

TEST_F(RunPatientTest, AsksForANameWhereThereIsNone) {
  const CommandResult result = run("");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.text.find("name a patient"), std::string::npos) << result.text;
}

TEST_F(RunPatientTest, KeepsNamesOfItsOwnResults) {
  for (const char* name :
       {"evaluation", "gel_cylinder", "cohort.tsv", "cohort_times.tsv", "failed.tsv"})
    EXPECT_EQ(run(name).exit_code, 2) << name;
}

TEST_F(RunPatientTest, NamesThePatientFileThatIsMissing) {
  const CommandResult result = run("nobody");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.text.find("nobody/patient.toml: no such file"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "results"));
}

TEST_F(RunPatientTest, DoesNotTakeAnEmptyFolderForTheRoot) {
  for (const char* variable : {"RESULTS", "DATA"}) {
    std::vector<std::string> environment{"P=a", "DATA=" + folder_.string(), "RESULTS=r",
                                         "BIN=" MAMMOTWIN_BIN};
    environment.push_back(std::string(variable) + "=");
    const CommandResult result =
        run_command({MAMMOTWIN_SOURCE_DIR "/pipeline/run_patient.sh", "patient"}, environment);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.text.find(std::string(variable) + " is empty"), std::string::npos)
        << result.text;
  }
}

TEST_F(RunPatientTest, MakeExpandsNothingInItsVariables) {
  const std::string mark = (folder_ / "mark").string();
  for (const char* variable : {"P", "DATA", "RESULTS", "FORCE", "SEED", "PRESS", "TABLE", "UNLOAD"})
    run_command({"make", "-C", MAMMOTWIN_SOURCE_DIR, "--dry-run", "patient",
                 std::string(variable) + "=$(shell touch " + mark + ")"});
  EXPECT_FALSE(std::filesystem::exists(mark));
}

// Words of a variable are words of a command, and no command themselves.
TEST_F(RunPatientTest, WordsOfAVariableReachNoShell) {
  const std::string mark = (folder_ / "mark").string();
  std::filesystem::create_directories(folder_ / "bin");
  const CommandResult run =
      run_command({"make", "-C", MAMMOTWIN_SOURCE_DIR, "-o", "mammotwin-evaluate-gravity",
                   "evaluate-gravity", "BIN=" + (folder_ / "bin").string(),
                   "UNLOAD=--a;touch " + mark + " `touch " + mark + "` $(touch " + mark + ")"});
  EXPECT_NE(run.exit_code, 0) << "there is no such program in BIN";
  EXPECT_FALSE(std::filesystem::exists(mark));
}

TEST_F(RunPatientTest, SaysWhereMemoryIsTooShortForTheProgramsToBegin) {
  std::filesystem::create_directories(folder_ / "a");
  write("a/patient.toml", "");
  const CommandResult run = run_command(
      {"prlimit", "--as=209715200", MAMMOTWIN_SOURCE_DIR "/pipeline/run_patient.sh", "patient"},
      {"P=a", "DATA=" + folder_.string(), "RESULTS=" + (folder_ / "results").string(),
       "BIN=" MAMMOTWIN_BIN});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.text.find("memory is limited to 200 MiB"), std::string::npos) << run.text;
}

TEST_F(RunPatientTest, NoTargetTakesAnEmptyFolderForTheRoot) {
  for (const char* target : {"patient", "cohort", "evaluate-unload"}) {
    const CommandResult run =
        run_command({"make", "-C", MAMMOTWIN_SOURCE_DIR, "--dry-run", target, "RESULTS="});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.text.find("RESULTS is empty"), std::string::npos) << run.text;
  }
  const CommandResult run = run_command({MAMMOTWIN_SOURCE_DIR "/pipeline/cohort/run_cohort.sh"},
                                        {"DATA=" + folder_.string(), "RESULTS="});
  EXPECT_EQ(run.exit_code, 2);
}

}  // namespace
}  // namespace mammotwin
