#pragma once

#include <array>
#include <cstdint>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// Red, green, blue in [0, 1] of a label of `segmentation.seg.nrrd` wherever it is shown (in 3D
/// Slicer, on the page). Hues of Okabe and Ito, "Color Universal Design" (2008), which people with
/// any kind of colour vision tell apart; muscle, which is not breast, is grey.
constexpr std::array<double, 3> label_colour(std::uint8_t value) {
  switch (value) {
    case label::skin:
      return {0.800, 0.475, 0.655};  // reddish purple
    case label::fat:
      return {0.941, 0.894, 0.259};  // yellow
    case label::fibroglandular:
      return {0.337, 0.706, 0.914};  // sky blue
    case label::muscle:
      return {0.350, 0.350, 0.350};
    default:
      return {0.835, 0.369, 0.000};  // vermillion
  }
}

}  // namespace mammotwin
