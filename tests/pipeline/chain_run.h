#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/pipeline/command.h"

namespace mammotwin {

/// The scripts of `make` on one patient.
struct ChainRun {
  std::string patient;
  std::filesystem::path data, results;

  std::vector<std::string> environment() const;
  /// `script` of pipeline/, with or without a target.
  CommandResult run_script(const std::string& script, const std::string& target = "") const;
  /// Names and bytes of the patient's products; sidecars, which hold times, are left out.
  std::map<std::string, std::string> products() const;
};

}  // namespace mammotwin
