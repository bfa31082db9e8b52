#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mammotwin {

struct ColourPicture;

/// Grey pixels row by row from the top.
struct GreyPixels {
  int columns = 0, rows = 0;
  std::vector<std::uint16_t> grey;
};

/// Writes a PNG of 16 bits a pixel, or of 8 bits a colour. Throws std::runtime_error naming the
/// path if it cannot be written.
void write_png(const std::filesystem::path& path, const GreyPixels& pixels);
void write_png(const std::filesystem::path& path, const ColourPicture& picture);

}  // namespace mammotwin
