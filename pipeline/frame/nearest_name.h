#pragma once

#include <string>
#include <vector>

namespace mammotwin {

/// The candidate with the fewest edits (insert, delete, replace, swap neighbours) from `name`.
/// Requires at least one candidate.
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace mammotwin
