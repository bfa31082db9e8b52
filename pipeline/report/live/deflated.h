#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mammotwin {

/// Bytes as zlib packs them, in base64: the page's scripts inflate them.
std::string deflated(const std::vector<std::uint8_t>& bytes);

/// Numbers as little-endian bytes.
template <class T>
std::vector<std::uint8_t> bytes_of(const std::vector<T>& numbers) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(numbers.data());
  return {first, first + numbers.size() * sizeof(T)};
}

}  // namespace mammotwin
