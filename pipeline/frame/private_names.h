#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mammotwin {

/// What stands for a file in a product: "cc mammogram" for the key views.cc.mammogram, "mri" for
/// mri.path.
std::string role_of_key(const std::string& key);

/// The names of a run's input files and folders. Hospitals name files after patients: the terminal
/// gives them as they are, what a run leaves says role and checksum ("cc mammogram 5f2c91d07a3b").
class PrivateNames {
 public:
  /// `path` as it was given (relative to where this program runs); a folder's files are added, too.
  void add(const std::string& role, const std::filesystem::path& path);

  /// Every file in a folder, which is not named itself.
  void add_files_of(const std::string& role, const std::filesystem::path& folder);

  /// A name that nothing is known to stand behind, as one that leads nowhere.
  void add_text(const std::string& role, const std::string& name);

  /// The role of a file that was added; empty for any other.
  std::string role_of(const std::filesystem::path& path) const;

  /// The text with a role and a checksum for each name that stands in it as a word. Names of one or
  /// two characters and numbers of up to four digits stay: they tell nobody, and are in any text.
  std::string without(const std::string& text) const;

  /// The same for every sentence in it; single words are codes and stay.
  nlohmann::json without_in(nlohmann::json value) const;

 private:
  struct Meaning {
    std::string role;
    std::filesystem::path file;  ///< empty: no checksum is said
  };
  std::map<std::string, std::string> roles_;  ///< by canonical path
  std::map<std::string, Meaning> meanings_;   ///< by a form of a name
};

}  // namespace mammotwin
