#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace mammotwin {

/// "synthetic-017 mlo  reached  ..." : one compression on one line.
std::string line_of(const nlohmann::json& row);

/// How many reached, of the synthetic breasts, of their hard ones, of patients', and a line for
/// each that did not. Those that are not possible are counted apart.
std::string compression_summary(const nlohmann::json& rows);

}  // namespace mammotwin
