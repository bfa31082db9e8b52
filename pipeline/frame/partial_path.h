#pragma once

#include <filesystem>
#include <string>

namespace mammotwin {

/// Where something is written before it gets its name: ".partial-<process>-<name>-<random>" in the
/// same folder. The random part keeps others who may write there from having laid a link in wait.
std::filesystem::path partial_path(const std::filesystem::path& folder, const std::string& name);

/// Removes what a run that was killed left under such a path for `name`; a live process keeps its
/// own.
void remove_partial_leftovers(const std::filesystem::path& folder, const std::string& name);

/// What is in the file, or the folder's list of names, outlasts a loss of power from here on.
/// Throws std::runtime_error naming a path that cannot be brought to the disk.
void make_durable(const std::filesystem::path& path);

/// Makes a new file and writes it whole and durably. Throws std::runtime_error where the path is
/// there already, also as a link, or cannot be written; nothing is left then.
void write_new_file(const std::filesystem::path& path, const std::string& text);

}  // namespace mammotwin
