#pragma once

#include <cstdint>
#include <filesystem>

namespace mammotwin {

/// GDCM fills what is missing at the end of a file without a word. Throws std::runtime_error,
/// without the path, where the file ends before its pixel data does: `expected` bytes where they
/// are not compressed, else the end that compressed pixel data announce.
void check_pixels_whole(const std::filesystem::path& file, std::uintmax_t expected);

}  // namespace mammotwin
