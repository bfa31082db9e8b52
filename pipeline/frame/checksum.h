#pragma once

#include <filesystem>
#include <string>

namespace mammotwin {

/// SHA-256 in hexadecimal of a file's bytes; of a folder: of its files' names and bytes, sorted by
/// relative path. Throws std::runtime_error naming a path that cannot be read.
std::string sha256_of_path(const std::filesystem::path& path);

std::string sha256_of_text(const std::string& text);

}  // namespace mammotwin
