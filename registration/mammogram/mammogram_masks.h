#pragma once

#include <cstdint>
#include <vector>

#include "registration/mammogram/mammogram_image.h"

namespace mammotwin {

/// Smoothed copy; sigma in pixels.
MammogramImage smoothed(const MammogramImage& image, double sigma);

/// Pixels of one connected region, largest region first: region n has the value n + 1, others 0.
std::vector<std::uint32_t> regions_above(const MammogramImage& image, float threshold);

}  // namespace mammotwin
