#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "registration/mammogram/mammogram_image.h"

namespace mammotwin {

/// Smoothed copy; sigma in pixels.
MammogramImage smoothed(const MammogramImage& image, double sigma);

/// Means over squares of `factor` pixels; what is left over at the right and bottom is dropped.
MammogramImage shrunk(const MammogramImage& image, int factor);

/// The grey that best parts an image's values into dark and bright (Otsu 1979).
float otsu_threshold(const MammogramImage& image);

/// Pixels of one connected region, largest region first: region n has the value n + 1, others 0.
std::vector<std::uint32_t> regions_above(const MammogramImage& image, float threshold);

/// A mask (0 and 1) without what is thinner than a disc of `radius` pixels.
MammogramImage opened(const MammogramImage& mask, int radius);

/// The longest closed border of a mask, through pixel centres' coordinates (column, row), points
/// about a pixel apart; the image's own border counts as outside.
std::vector<std::array<double, 2>> longest_border(const MammogramImage& mask);

}  // namespace mammotwin
