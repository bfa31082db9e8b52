#include "registration/mammogram/nipple_marker.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "registration/mammogram/mammogram_masks.h"

namespace mammotwin {
namespace {

constexpr double kSmallest_mm = 1, kLargest_mm = 5;
constexpr double kSaturated = 0.98;  // of the brightest grey

struct Disc {
  int low_column = 1 << 30, high_column = -1, low_row = 1 << 30, high_row = -1, pixels = 0;
  int width() const { return high_column - low_column + 1; }
  int height() const { return high_row - low_row + 1; }

  void add(int column, int row) {
    low_column = std::min(low_column, column);
    high_column = std::max(high_column, column);
    low_row = std::min(low_row, row);
    high_row = std::max(high_row, row);
    ++pixels;
  }
};

bool is_marker(const Disc& d, double pixel_mm) {
  constexpr double kRound = 0.2, kFull = 0.1;  // of its size, of the area of an ellipse
  const double size = std::max(d.width(), d.height());
  const double fill = d.pixels / (0.25 * M_PI * d.width() * d.height());
  return size * pixel_mm > kSmallest_mm && size * pixel_mm < kLargest_mm &&
         std::abs(d.width() - d.height()) < kRound * size && std::abs(fill - 1) < kFull;
}

}  // namespace

std::optional<Eigen::Vector2d> find_marker(const MammogramImage& image, double pixel_mm) {
  const auto [dark, bright] = std::minmax_element(image.grey.begin(), image.grey.end());
  const float saturated = static_cast<float>(*dark + kSaturated * (*bright - *dark));
  const auto regions = regions_above(image, saturated);
  std::vector<Disc> discs(*std::max_element(regions.begin(), regions.end()) + 1);
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column)
      if (const auto region = regions[static_cast<std::size_t>(row) * image.columns + column])
        discs[region].add(column, row);
  std::optional<Eigen::Vector2d> found;
  for (const Disc& d : discs) {
    if (d.pixels == 0 || !is_marker(d, pixel_mm)) continue;
    if (found) return std::nullopt;
    found = Eigen::Vector2d(d.low_column + d.high_column, d.low_row + d.high_row) / 2;
  }
  return found;
}

}  // namespace mammotwin
