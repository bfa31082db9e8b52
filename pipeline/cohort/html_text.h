#pragma once

#include <string>

namespace mammotwin {

/// `text` as it can stand between tags and in quoted attributes.
std::string html_text(const std::string& text);

/// Four significant digits.
std::string short_number(double value);

}  // namespace mammotwin
