#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mammotwin {

/// Grey pixels row by row from the top.
struct GreyPixels {
  int columns = 0, rows = 0;
  std::vector<std::uint16_t> grey;
};

/// Writes a 16-bit PNG. Throws std::runtime_error naming the path if it cannot be written.
void write_png(const std::filesystem::path& path, const GreyPixels& pixels);

}  // namespace mammotwin
