#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "pipeline/report/drawing/picture.h"
#include "segmentation/files/label_colour.h"
#include "segmentation/segmentation.h"

namespace mammotwin::palette {

inline constexpr Colour ink{0.11, 0.14, 0.19};
inline constexpr Colour quiet{0.36, 0.41, 0.47};
inline constexpr Colour grid{0.87, 0.89, 0.91};
inline constexpr Colour paper{1, 1, 1};
inline constexpr Colour plate{0.45, 0.52, 0.60};

/// Colour of a label of `segmentation.seg.nrrd`; air is transparent.
inline constexpr Colour of_label(std::uint8_t value) {
  if (value == label::air) return {0, 0, 0, 0};
  const auto c = label_colour(value);
  return {c[0], c[1], c[2]};
}
inline constexpr Colour skin = of_label(label::skin);
inline constexpr Colour fat = of_label(label::fat);
inline constexpr Colour muscle = of_label(label::muscle);

// Marks, of Okabe and Ito's hues, too (label_colour.h).
inline constexpr Colour lesion = of_label(label::lesion);
inline constexpr Colour nipple{0.000, 0.447, 0.698};      // blue
inline constexpr Colour baseline{0.941, 0.894, 0.259};    // yellow
inline constexpr Colour mesh = baseline;                  // on an MRI, where no baseline is drawn
inline constexpr Colour third_line{0.800, 0.475, 0.655};  // in charts on paper
inline constexpr Colour own_mark = third_line;            // what a reader marks on the page

/// A mark on an image is edged light, and dark outside that: on any grey one of the two has a
/// contrast of 3 to 1 at least (WCAG 2.2, 1.4.11).
inline constexpr Colour light_edge = paper;
inline constexpr Colour dark_edge{0, 0, 0};

/// "#d55e00", as CSS has it.
inline std::string css(const Colour& c) {
  const auto byte = [](double share) { return static_cast<int>(share * 255 + 0.5); };
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(c.red), byte(c.green), byte(c.blue));
  return text;
}

inline Colour with_alpha(Colour colour, double alpha) {
  colour.alpha *= alpha;
  return colour;
}

/// White at 0, blue at -1 and beyond, red at 1 and beyond: inside and outside of what is compared.
inline Colour inside_outside(double share) {
  const double t = std::clamp(share, -1.0, 1.0), a = std::abs(t);
  const Colour end = t < 0 ? nipple : lesion;
  constexpr double white = 0.96;
  return {white + a * (end.red - white), white + a * (end.green - white),
          white + a * (end.blue - white), 1};
}

/// `top` drawn over an opaque `below`.
inline Colour over(const Colour& top, const Colour& below) {
  const double a = top.alpha, b = 1 - a;
  return {a * top.red + b * below.red, a * top.green + b * below.green,
          a * top.blue + b * below.blue, 1};
}

}  // namespace mammotwin::palette
