#pragma once

#include <optional>
#include <vector>

namespace mammotwin {

/// Part of an image that a collimator leaves open; the last column and row are within.
struct ExposedField {
  int first_column, last_column, first_row, last_row;
};

/// Grey values of a mammogram as stored, row by row from the top.
struct MammogramImage {
  int columns = 0, rows = 0;
  std::vector<float> grey;
  std::optional<ExposedField> field{};  ///< where it is known

  float& at(int column, int row) { return grey[static_cast<std::size_t>(row) * columns + column]; }
  float at(int column, int row) const {
    return grey[static_cast<std::size_t>(row) * columns + column];
  }
};

}  // namespace mammotwin
