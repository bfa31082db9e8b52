#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "pipeline/frame/settings.h"

namespace mammotwin {

/// A file or folder that a settings file names, and the key that names it.
struct NamedFile {
  std::string key;
  std::filesystem::path path;  ///< as it stands there
};

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
  virtual void read(const std::filesystem::path& file, Settings& settings) = 0;

  /// Every file and folder that is named, there or not.
  virtual std::vector<NamedFile> named_files() const = 0;

  /// A path as it stands in the file, which may be relative to it.
  virtual std::filesystem::path resolve(const std::filesystem::path& path) const = 0;

  /// May products name input files as they are called?
  virtual bool keeps_names() const = 0;

  /// Keys of tables that may stand any number of times, for the table of settings: "lesions[].id".
  virtual Settings list_settings() const = 0;

  /// Parameters that come in lists below these prefixes, in the sidecar's form.
  virtual nlohmann::json list_parameters(const std::vector<std::string>& prefixes) const = 0;
};

}  // namespace mammotwin
