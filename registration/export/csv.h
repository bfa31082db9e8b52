#pragma once

#include <string>
#include <vector>

/// Comma separated values as RFC 4180 has them, a record a line.
namespace mammotwin::csv {

/// Text as one cell, in quotes where it needs them.
std::string quoted(const std::string& text);

std::vector<std::string> cells(const std::string& line);

/// Throws std::runtime_error "<where> is "<text>"; expected a number or nothing".
double number(const std::string& text, const std::string& where);

}  // namespace mammotwin::csv
