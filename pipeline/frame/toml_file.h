#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace mammotwin {

/// A TOML file's values by dotted key, in the order of the file. A list of tables stays a list of
/// objects; every other table is walked into.
using TomlValues = std::vector<std::pair<std::string, nlohmann::json>>;

/// Throws std::runtime_error naming the file, and line and column of a syntax error.
TomlValues read_toml(const std::filesystem::path& file);

}  // namespace mammotwin
