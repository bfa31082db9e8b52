#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace mammotwin {

/// Writes a changed copy of `input` of at most `most` bytes to `out` and returns its size: bytes as
/// libFuzzer changes them, or a number of a text, or a line left out or doubled, or bytes inside a
/// gzip member or inside the compressed base64 of an array of a .vtu file, which changes outside
/// would only break.
std::size_t mutate(const std::string& input, std::uint8_t* out, std::size_t most, unsigned seed);

}  // namespace mammotwin
