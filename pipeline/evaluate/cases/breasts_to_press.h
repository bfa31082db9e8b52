#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mammotwin {

/// A breast to press, with the file that says how.
struct BreastToPress {
  std::string name;
  std::filesystem::path patient_toml;
  std::filesystem::path folder;  ///< gets its files
};

/// A patient of ours, and of a folder of real cases those that `only` names by parts of their names
/// (all where it names none), pressed to 55 mm. Each gets a folder of its name in `folder`.
std::vector<BreastToPress> breasts_to_press(const std::filesystem::path& patient_toml,
                                            const std::filesystem::path& cases,
                                            const std::vector<std::string>& only,
                                            const std::filesystem::path& folder);

}  // namespace mammotwin
