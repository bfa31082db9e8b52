#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/pipeline/command.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/where.h"

namespace mammotwin {

/// A folder of patients and one of results, and `make patient`'s script on them.
class PatientCase : public ScratchFolder {
 protected:
  /// Writes `toml` for a patient and returns the patient's folder.
  std::filesystem::path patient(const std::string& name, const std::string& toml) {
    const auto folder = data() / name;
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "patient.toml") << toml;
    return folder;
  }

  CommandResult run(const std::string& stage, const std::string& name) {
    return run_command({MAMMOTWIN_SOURCE_DIR "/pipeline/run_patient.sh", stage},
                       {"P=" + name, "DATA=" + data().string(), "RESULTS=" + results().string(),
                        "BIN=" MAMMOTWIN_BIN});
  }

  std::filesystem::path data() const { return folder_ / "data"; }
  std::filesystem::path results() const { return folder_ / "results"; }

  nlohmann::json sidecar(const std::string& name, const std::string& product) const {
    std::ifstream in(results() / name / (product + ".json"));
    return in ? nlohmann::json::parse(in) : nlohmann::json();
  }

  /// Of every product: what did not run again keeps it.
  std::map<std::string, std::filesystem::file_time_type> times_of_change(
      const std::string& name) const {
    std::map<std::string, std::filesystem::file_time_type> times;
    for (const auto& entry : std::filesystem::directory_iterator(results() / name))
      times[entry.path().filename().string()] = std::filesystem::last_write_time(entry.path());
    return times;
  }
};

}  // namespace mammotwin
