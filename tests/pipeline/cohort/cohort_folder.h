#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/pipeline/command.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/where.h"

namespace mammotwin {

/// A scratch folder with data/, results/ and bin/, where the stages are fakes inside the real frame
/// (cohort_fake_stage.cpp) and the cohort's own programs are real.
class CohortFolderTest : public ScratchFolder {
 protected:
  CohortFolderTest() {
    namespace fs = std::filesystem;
    fs::create_directories(folder_ / "bin");
    for (const char* stage : {"segment", "fit", "unload", "compress", "register", "report"})
      fs::create_symlink(MAMMOTWIN_BIN "/cohort_fake_stage", program(stage));
    for (const char* name : {"cohort", "verify"})
      fs::create_symlink(std::string(MAMMOTWIN_BIN "/mammotwin-") + name, program(name));
  }

  std::filesystem::path program(const std::string& name) const {
    return folder_ / "bin" / ("mammotwin-" + name);
  }
  std::filesystem::path results(const std::string& name = "") const {
    return folder_ / "results" / name;
  }

  void add_patient(const std::string& name, const std::string& behaviour = "") const {
    std::filesystem::create_directories(folder_ / "data" / name / "mri");
    write("data/" + name + "/patient.toml", "");
    write("data/" + name + "/mri/volume.txt", name);
    write("data/" + name + "/behaviour.txt", behaviour + "\n");
  }

  std::vector<std::string> environment(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"DATA=" + (folder_ / "data").string(),
                                 "RESULTS=" + results().parent_path().string(),
                                 "BIN=" + (folder_ / "bin").string()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  CommandResult run_cohort(const std::vector<std::string>& more = {}) const {
    return run_command({MAMMOTWIN_SOURCE_DIR "/pipeline/cohort/run_cohort.sh"}, environment(more));
  }
  CommandResult run_patient(const std::string& patient) const {
    return run_command({MAMMOTWIN_SOURCE_DIR "/pipeline/run_patient.sh", "patient"},
                       environment({"P=" + patient}));
  }
  CommandResult verify(const std::string& patient) const {
    std::vector<std::string> words{program("verify").string(), results(patient).string()};
    if (const auto data = folder_ / "data" / patient; std::filesystem::exists(data))
      words.insert(words.end(), {"--data", data.string()});
    return run_command(words);
  }

  /// Rows of a table in results/ by patient; each maps a column's name to its value.
  std::map<std::string, std::map<std::string, std::string>> table(const std::string& name) const;
};

}  // namespace mammotwin
