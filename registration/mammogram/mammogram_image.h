#pragma once

#include <filesystem>
#include <vector>

namespace mammotwin {

/// Grey values of a mammogram as stored, row by row from the top.
struct MammogramImage {
  int columns = 0, rows = 0;
  std::vector<float> grey;

  float& at(int column, int row) { return grey[static_cast<std::size_t>(row) * columns + column]; }
  float at(int column, int row) const {
    return grey[static_cast<std::size_t>(row) * columns + column];
  }
};

/// Reads a grey PNG (8 or 16 bit). Throws std::runtime_error naming the file and what is wrong.
MammogramImage read_mammogram_png(const std::filesystem::path& path);

}  // namespace mammotwin
