#pragma once

#include <cmath>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// A breast that is a bell on a flat chest wall: skin at y = −12 − height · exp(−r² / (2 · 22²)),
/// muscle from y = 0, fat between, the other side empty as `segment` leaves it.
inline Segmentation dome_breast(double height_mm = 40, double spacing_mm = 2) {
  const int n = static_cast<int>(120 / spacing_mm);
  Segmentation s;
  s.labels =
      Volume<std::uint8_t>({n, static_cast<int>((height_mm + 40) / spacing_mm), n},
                           Eigen::Vector3d::Constant(spacing_mm), {-40, -height_mm - 24, -60});
  s.region = {Side::left, -40 - spacing_mm / 2, 40 + spacing_mm / 2, -42 - spacing_mm / 2,
              42 + spacing_mm / 2};
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i) {
        const Eigen::Vector3d x = s.labels.position(i, j, k);
        const double r2 = x.x() * x.x() + x.z() * x.z();
        const double skin = -12 - height_mm * std::exp(-r2 / (2 * 22 * 22));
        s.labels(i, j, k) = x.y() > 0 ? label::muscle : x.y() > skin ? label::fat : label::air;
      }
  s.fractions = s.labels.like<Fractions>({});
  return s;
}

}  // namespace mammotwin
