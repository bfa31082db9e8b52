#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace mammotwin {

/// A figure as a person reads it: "skin rms mesh to data", "0.220", "mm".
struct QualityFigure {
  std::string name, value, unit;
  std::string key;  ///< in the sidecar; of an unfolded one that of its list or object
};

/// One line for each figure under a sidecar's `quality`, units taken from the ends of the names;
/// lists and objects are unfolded, per-step histories and detector settings left out.
std::vector<QualityFigure> quality_figures(const nlohmann::json& quality);

/// A value on one line: numbers to four digits, lists in brackets, "not known" for null.
std::string shown_value(const nlohmann::json& value);

}  // namespace mammotwin
