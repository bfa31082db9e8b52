#pragma once

#include "pipeline/report/picture.h"
#include "segmentation/segmentation.h"

namespace mammotwin::palette {

inline constexpr Colour ink{0.11, 0.14, 0.19};
inline constexpr Colour quiet{0.36, 0.41, 0.47};
inline constexpr Colour grid{0.87, 0.89, 0.91};
inline constexpr Colour paper{1, 1, 1};
inline constexpr Colour lesion{0.85, 0.07, 0.38};
inline constexpr Colour nipple{0.00, 0.42, 0.58};
inline constexpr Colour baseline{0.72, 0.42, 0.00};
inline constexpr Colour baseline_label{1.00, 0.76, 0.35};  // read on black
inline constexpr Colour mesh{0.15, 0.80, 0.95};
inline constexpr Colour plate{0.45, 0.52, 0.60};
inline constexpr Colour skin{0.93, 0.72, 0.60};
inline constexpr Colour fat{0.99, 0.90, 0.65};
inline constexpr Colour fibroglandular{0.36, 0.60, 0.85};
inline constexpr Colour muscle{0.70, 0.25, 0.22};

/// Colour of a label of `segmentation.seg.nrrd`; air is transparent.
inline Colour of_label(std::uint8_t value) {
  if (label::is_lesion(value)) return lesion;
  switch (value) {
    case label::skin:
      return skin;
    case label::fat:
      return fat;
    case label::fibroglandular:
      return fibroglandular;
    case label::muscle:
      return muscle;
    default:
      return {0, 0, 0, 0};
  }
}

inline Colour with_alpha(Colour colour, double alpha) {
  colour.alpha *= alpha;
  return colour;
}

/// `top` drawn over an opaque `below`.
inline Colour over(const Colour& top, const Colour& below) {
  const double a = top.alpha, b = 1 - a;
  return {a * top.red + b * below.red, a * top.green + b * below.green,
          a * top.blue + b * below.blue, 1};
}

}  // namespace mammotwin::palette
