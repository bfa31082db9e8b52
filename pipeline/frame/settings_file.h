#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/frame/settings.h"

namespace mammotwin {

/// The file in which a user says what holds for every stage. The frame passes its values on and
/// does not know what they are about.
class SettingsFile {
 public:
  virtual ~SettingsFile() = default;

  /// "patient": `--patient` on the command line names a patient.toml.
  virtual std::string subject() const = 0;

  /// Enters every key that the file may have in the table.
  virtual void declare(Settings& settings) = 0;

  /// Reads the file. Throws std::runtime_error naming file and key where it cannot serve.
  virtual void read(const std::filesystem::path& file, const Settings& settings) = 0;

  /// Keys of tables that may stand any number of times, for the table of settings: "lesions[].id".
  virtual Settings list_settings() const = 0;

  /// Parameters that come in lists below these prefixes, in the sidecar's form.
  virtual nlohmann::json list_parameters(const std::vector<std::string>& prefixes) const = 0;
};

}  // namespace mammotwin
