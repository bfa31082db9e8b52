#include <filesystem>

#include "tests/pipeline/cohort/cohort_folder.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

class RunCohort : public CohortFolderTest {
 protected:
  /// One patient for each way to end.
  void add_all_kinds() const {
    add_patient("fine");
    add_patient("thin", "look fit");
    add_patient("cube", "refuse fit");
    add_patient("stiff", "diverge compress");
    add_patient("killed", "die register");
  }
};

TEST_F(RunCohort, GivesEveryPatientALineHoweverItEnded) {
  add_all_kinds();
  const CommandResult run = run_cohort({"JOBS=3"});
  EXPECT_EQ(run.exit_code, 1) << run.text;
  auto rows = table("cohort.tsv");
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows["fine"]["status"], "ok");
  EXPECT_EQ(rows["thin"]["status"], "look");
  EXPECT_EQ(rows["thin"]["reason"], "prone: the skin is thin");
  EXPECT_EQ(rows["cube"]["status"], "refused");
  EXPECT_EQ(rows["cube"]["stage"], "fit");
  EXPECT_EQ(rows["cube"]["reason"], "the breast is a <cube>");
  EXPECT_EQ(rows["stiff"]["status"], "not_converged");
  EXPECT_EQ(rows["stiff"]["cc.thickness_mm"], "61.2");
  EXPECT_EQ(rows["killed"]["status"], "interrupted");
  EXPECT_EQ(rows["killed"]["stage"], "register");
}

TEST_F(RunCohort, KeepsEveryQualityFigureAndNoCurve) {
  add_patient("fine");
  run_cohort();
  auto row = table("cohort.tsv")["fine"];
  for (const char* product : {"segmentation", "prone", "cc", "mlo", "lesions", "report"})
    for (const char* figure : {".figure_mm", ".elements.2", ".side", ".lesions.a.volume_ml"})
      EXPECT_FALSE(row[std::string(product) + figure].empty()) << product << figure;
  for (const auto& [column, value] : row)
    EXPECT_EQ(column.find("history"), std::string::npos) << column;
}

TEST_F(RunCohort, ListsFailuresWithTheCommandThatRunsThemAgain) {
  add_all_kinds();
  run_cohort();
  auto failed = table("failed.tsv");
  EXPECT_EQ(failed.size(), 3u);
  EXPECT_EQ(failed["stiff"]["command"], R"(make patient P=stiff DATA="$DATA" RESULTS="$RESULTS")");
}

TEST_F(RunCohort, RunsOnlyTheFailedAgain) {
  add_all_kinds();
  run_cohort();
  const auto before = fs::last_write_time(results("fine/prone.vtu.json"));
  for (const char* name : {"cube", "stiff", "killed"}) add_patient(name);
  const CommandResult again = run_cohort({"ONLY=failed"});
  EXPECT_EQ(again.exit_code, 0) << again.text;
  EXPECT_NE(again.text.find("3 patients,"), std::string::npos) << again.text;
  EXPECT_EQ(table("cohort.tsv").size(), 5u);
  EXPECT_TRUE(table("failed.tsv").empty());
  EXPECT_EQ(fs::last_write_time(results("fine/prone.vtu.json")), before);
}

TEST_F(RunCohort, DoesNotRunAFailureAgainUntilSomethingHasChanged) {
  add_patient("cube", "refuse fit");
  add_patient("stiff", "diverge compress");
  run_cohort();
  const std::string failed = text_of(results("failed.tsv"));
  const auto refused = [&] { return fs::last_write_time(results("cube/prone.vtu.json")); };
  const auto diverged = [&] { return fs::last_write_time(results("stiff/cc.vtu.json")); };
  const auto first_refused = refused(), first_diverged = diverged();
  EXPECT_EQ(run_cohort().exit_code, 1);
  EXPECT_EQ(refused(), first_refused);
  EXPECT_EQ(diverged(), first_diverged);
  EXPECT_EQ(text_of(results("failed.tsv")), failed);
  EXPECT_NE(text_of(results(".cohort/logs/cube.txt")).find("it is not run again"),
            std::string::npos);
  run_cohort({"FORCE=1"});
  EXPECT_NE(refused(), first_refused);
  add_patient("stiff");
  run_cohort();
  EXPECT_EQ(table("cohort.tsv")["stiff"]["status"], "ok");
}

TEST_F(RunCohort, KeepsWhatOneViewGivesWhereTheOtherIsNotReached) {
  add_patient("half", "diverge compress cc");
  const CommandResult run = run_patient("half");
  EXPECT_EQ(run.exit_code, 3) << run.text;
  EXPECT_NE(run.text.find("half stopped at compress; without cc"), std::string::npos) << run.text;
  run_cohort();
  auto row = table("cohort.tsv")["half"];
  EXPECT_EQ(row["status"], "not_converged");
  EXPECT_EQ(row["stage"], "compress");
  EXPECT_EQ(row["reason"], "the last good thickness is 61.2 mm");
  EXPECT_FALSE(row["mlo.figure_mm"].empty());
  EXPECT_FALSE(row["lesions.figure_mm"].empty());
  EXPECT_EQ(verify("half").exit_code, 0) << verify("half").text;

  const auto registered = [&] { return fs::last_write_time(results("half/lesions.csv")); };
  const auto before = registered();
  run_patient("half");
  EXPECT_EQ(registered(), before);
  add_patient("half");
  EXPECT_EQ(run_patient("half").exit_code, 0);
  EXPECT_NE(registered(), before);
  add_patient("half", "diverge compress");
  EXPECT_EQ(run_patient("half").exit_code, 3);
  EXPECT_FALSE(fs::exists(results("half/mlo.vtu")));
}

TEST_F(RunCohort, WritesTheSameTableAtAnyNumberOfJobs) {
  add_all_kinds();
  run_cohort({"JOBS=1"});
  const std::string table = text_of(results("cohort.tsv")), page = text_of(results("cohort.html"));
  fs::remove_all(results());
  run_cohort({"JOBS=4"});
  EXPECT_EQ(text_of(results("cohort.tsv")), table);
  EXPECT_EQ(text_of(results("cohort.html")), page);
}

TEST_F(RunCohort, RunsOnlyTheNamedAndListsThoseWithResults) {
  for (const char* name : {"a", "b", "c"}) add_patient(name);
  run_cohort({"PATIENTS=a c"});
  EXPECT_EQ(table("cohort.tsv").size(), 2u);
  run_cohort({"PATIENTS=b"});
  EXPECT_EQ(table("cohort.tsv").size(), 3u);
}

TEST_F(RunCohort, SaysOfAPatientThatDoesNotExistThatItsFileIsMissing) {
  add_patient("fine");
  EXPECT_EQ(run_cohort({"PATIENTS=fine nobody"}).exit_code, 1);
  EXPECT_EQ(table("cohort.tsv")["fine"]["status"], "ok");
  EXPECT_NE(table("failed.tsv")["nobody"]["reason"].find("no such file"), std::string::npos);
}

TEST_F(RunCohort, TakesNoFiguresThatOtherInputsGave) {
  add_patient("changed");
  run_cohort();
  write("data/changed/mri/volume.txt", "changed since");
  run_command({MAMMOTWIN_SOURCE_DIR "/pipeline/run_patient.sh", "segment"},
              environment({"P=changed"}));
  run_cohort({"PATIENTS=changed", "BIN=" MAMMOTWIN_BIN "/nowhere"});  // no program runs
  run_command({program("cohort").string(), results().parent_path().string()});
  auto row = table("cohort.tsv")["changed"];
  EXPECT_EQ(row["stage"], "segment");
  EXPECT_TRUE(row["prone.figure_mm"].empty());
}

TEST_F(RunCohort, LetsNoNameReachAShell) {
  const std::string mark = (folder_ / "mark").string();
  const std::string evil = "$(touch mark)";
  fs::create_directories(folder_ / "data" / evil);
  write("data/" + evil + "/patient.toml", "");
  add_patient("fine");
  EXPECT_NE(run_cohort().text.find("not a plain name"), std::string::npos);
  EXPECT_EQ(table("cohort.tsv").size(), 1u);
  for (const std::string& names : {"$(touch " + mark + ")", "`touch " + mark + "`",
                                   std::string("a;b"), std::string("../fine"), std::string("-x")})
    EXPECT_EQ(run_cohort({"PATIENTS=" + names}).exit_code, 2) << names;
  for (const char* variable : {"PATIENTS", "JOBS", "ONLY", "ENGINE", "CONFIG", "PREFIX"})
    run_command({"make", "-C", MAMMOTWIN_SOURCE_DIR, "--dry-run", "cohort",
                 std::string(variable) + "=$(shell touch " + mark + ")"});
  EXPECT_FALSE(fs::exists(mark));
  EXPECT_FALSE(fs::exists("mark"));
}

TEST_F(RunCohort, RunsNoMoreAtATimeThanFitInMemory) {
  add_patient("a");
  const auto config = write("conf", "memory_mb = 100000000\ncpus = 1\n");
  const CommandResult run = run_cohort({"JOBS=4", "CONFIG=" + config.string()});
  EXPECT_NE(run.text.find("1 patients, 1 at a time"), std::string::npos) << run.text;
  EXPECT_NE(run.text.find("JOBS=4 lowered to 1"), std::string::npos) << run.text;
}

TEST_F(RunCohort, RefusesWhatItDoesNotKnow) {
  add_patient("a");
  for (const char* bad : {"JOBS=0", "JOBS=many", "ONLY=good", "ENGINE=cloud", "CONFIG=/nowhere"})
    EXPECT_EQ(run_cohort({bad}).exit_code, 2) << bad;
  EXPECT_EQ(run_cohort({"DATA=/nowhere"}).exit_code, 2);
  EXPECT_EQ(run_cohort({"RESULTS=/proc/nowhere"}).exit_code, 2);
}

TEST_F(RunCohort, PageNamesFailuresFirstAndEscapesReasons) {
  add_all_kinds();
  run_cohort();
  const std::string page = text_of(results("cohort.html"));
  EXPECT_EQ(page.find("<cube>"), std::string::npos);
  EXPECT_NE(page.find("the breast is a &lt;cube&gt;"), std::string::npos);
  EXPECT_LT(page.find("id=\"failures\""), page.find("id=\"look\""));
  EXPECT_LT(page.find("id=\"look\""), page.find("id=\"distributions\""));
  EXPECT_NE(page.find("<a href=\"thin/report.html\">thin</a>"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);  // nothing is fetched
}

class VerifyResults : public CohortFolderTest {
 protected:
  VerifyResults() {
    add_patient("p");
    run_patient("p");
  }
};

TEST_F(VerifyResults, FindsNothingInFreshResults) {
  const CommandResult found = verify("p");
  EXPECT_EQ(found.exit_code, 0) << found.text;
  EXPECT_NE(found.text.find("0 differences"), std::string::npos) << found.text;
}

TEST_F(VerifyResults, NamesAProductThatWasChanged) {
  write("results/p/prone.exf", "edited");
  const CommandResult found = verify("p");
  EXPECT_EQ(found.exit_code, 1);
  EXPECT_NE(found.text.find("prone.exf: its SHA-256 is"), std::string::npos) << found.text;
  EXPECT_NE(found.text.find("written by fit"), std::string::npos) << found.text;
}

TEST_F(VerifyResults, NamesAnInputThatIsGone) {
  fs::remove_all(folder_ / "data/p/mri");
  const CommandResult found = verify("p");
  EXPECT_EQ(found.exit_code, 1);
  EXPECT_NE(found.text.find("the mri read for segmentation.seg.nrrd: no file of"),
            std::string::npos)
      << found.text;
}

// A run with fewer load steps has fewer meshes; one that fails has none.
TEST_F(VerifyResults, FindsNoFileOfAnEarlierRunThatALaterOneDidNotWrite) {
  write("results/p/mine.txt", "not the program's");
  for (const char* behaviour : {"short fit\n", "refuse fit\n"}) {
    run_patient("p");
    EXPECT_TRUE(fs::exists(results("p/prone.exf")));
    write("data/p/behaviour.txt", behaviour);
    run_patient("p");
    EXPECT_FALSE(fs::exists(results("p/prone.exf"))) << behaviour;
    EXPECT_EQ(fs::exists(results("p/prone.vtu")), behaviour == std::string("short fit\n"));
    EXPECT_TRUE(fs::exists(results("p/mine.txt")));
    write("data/p/behaviour.txt", "\n");
  }
}

TEST_F(VerifyResults, NamesHalfWrittenFilesAndFoldersWithoutResults) {
  write("results/p/.partial-1-prone.vtu", "half");
  EXPECT_NE(verify("p").text.find("half-written"), std::string::npos);
  EXPECT_EQ(verify("nobody").exit_code, 1);
}

/// Whether any sidecar of the chain names the patient's image.
bool names_the_image(const std::filesystem::path& results) {
  for (const auto& entry : std::filesystem::directory_iterator(results))
    if (std::ifstream in(entry.path());
        std::string(std::istreambuf_iterator<char>(in), {}).find("Doe_Jane") != std::string::npos)
      return true;
  return false;
}

TEST_F(RunCohort, KeepsNamesOfFilesOnlyWhereThePatientsFileSaysSo) {
  for (const std::string keep : {"false", "true"}) {
    add_patient("p");
    std::filesystem::create_directories(folder_ / "data" / "p" / "Doe_Jane");
    write("data/p/Doe_Jane/volume.txt", "an image");
    write("data/p/patient.toml", "mri.path = \"Doe_Jane\"\nprivacy.keep_names = " + keep + "\n");
    EXPECT_EQ(run_patient("p").exit_code, 0);
    EXPECT_EQ(names_the_image(results("p")), keep == "true") << keep;
  }
}

}  // namespace
}  // namespace mammotwin
