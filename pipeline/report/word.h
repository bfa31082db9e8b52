#pragma once

#include <cstdio>
#include <string>

namespace mammotwin::word {

/// A number with fixed decimals, without a negative zero.
inline std::string number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  const std::string plain = text;
  return plain.find_first_not_of("-0.") == std::string::npos && plain[0] == '-' ? plain.substr(1)
                                                                                : plain;
}

/// Lengths as a reader needs them: to 0.1 mm.
inline std::string mm(double value) { return number(value, 1); }

}  // namespace mammotwin::word
