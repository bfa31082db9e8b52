#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace mammotwin {

/// A quality figure of a patient: column name and a number, text or truth value.
using NamedValue = std::pair<std::string, nlohmann::json>;

/// The single values in a sidecar's `quality`, sorted by name below `prefix`: a nested table is
/// walked into, a list of up to three values gives name.0, name.1, name.2 (elements, points), a
/// list of things that have an `id` gives name.<id>.<key>. Longer lists are curves and give
/// nothing.
std::vector<NamedValue> figures_of(const std::string& prefix, const nlohmann::json& quality);

}  // namespace mammotwin
