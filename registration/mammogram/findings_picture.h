#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "registration/mammogram/mammogram_findings.h"

namespace mammotwin {

/// A colour picture, row by row from the top.
struct ColourPicture {
  using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

  ColourPicture(int columns, int rows, Colour colour = {0, 0, 0});
  /// A square of (2 reach + 1) pixels; what lies outside is left out.
  void dot(double column, double row, Colour colour, int reach = 0);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour);
  /// Puts another picture's left upper corner at (column, row).
  void paste(const ColourPicture& other, int column, int row);

  int columns, rows;
  std::vector<Colour> pixels;
};

/// A mammogram of about `height` rows with what was found: outline green; pectoral edge yellow,
/// straight, and red, as followed; nipple as a ring of one standard deviation, cyan, or orange
/// where it is unsure; other candidates as dots. `marks`: other pixels to show, magenta.
ColourPicture findings_picture(const MammogramImage& image, double pixel_mm,
                               const MammogramFindings& findings, int height,
                               const std::vector<Eigen::Vector2d>& marks = {});

}  // namespace mammotwin
