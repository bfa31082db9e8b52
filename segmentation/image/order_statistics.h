#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mammotwin {

/// The value with `share` (0 to 1) of the others below it. Reorders the values, which must not be
/// empty.
template <class Value>
Value quantile(std::vector<Value>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The middle value, of an even number the upper one. Reorders the values, which must not be empty.
template <class Value>
Value median(std::vector<Value>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace mammotwin
