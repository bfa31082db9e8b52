#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/frame/settings.h"

namespace mammotwin {

/// Everything that patient.toml may say: one options struct a stage, filled from one table of
/// settings (`declare`), so that the file, the command lines and the sidecars agree.
class Patient {
 public:
  Patient() = default;
  Patient(const Patient&) = delete;  // settings point into it
  Patient& operator=(const Patient&) = delete;

  /// Enters every key of patient.toml in the table.
  void declare(Settings& settings);

  /// Reads patient.toml. Throws std::runtime_error naming file and key where the file is missing,
  /// is not TOML, has an unknown key (the nearest known one is named) or a value out of range.
  void read(const std::filesystem::path& file, const Settings& settings);

  /// A path of patient.toml, relative to that file unless absolute.
  std::filesystem::path resolve(const std::filesystem::path& path) const;

  /// Parameters that come in lists (lesions) below these prefixes, in the sidecar's form.
  nlohmann::json list_parameters(const std::vector<std::string>& prefixes) const;

 private:
  std::filesystem::path folder_ = ".";
};

}  // namespace mammotwin
