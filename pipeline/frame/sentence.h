#pragma once

#include <cstdio>
#include <string>

namespace mammotwin {

/// What printf would print of numbers and C strings, however long.
template <class... Values>
std::string sentence(const char* format, Values... values) {
  std::string text(std::snprintf(nullptr, 0, format, values...), ' ');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

}  // namespace mammotwin
