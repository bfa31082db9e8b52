#pragma once

#include <algorithm>
#include <cmath>

namespace mammotwin {

/// Slices of a tomosynthesis volume, parallel to the support. They count from 1.
struct TomosynthesisSlices {
  int count = 0;
  double spacing_mm = 1;
  double lowest_mm = 0.5;        ///< middle of the slice nearest to the support, above it
  bool first_at_support = true;  ///< the first slice is that one; else the one at the paddle

  /// Slice at a height above the support [mm], with fractions; below 1 or above `count` beyond the
  /// volume.
  double slice_at(double height_mm) const {
    const double above = (height_mm - lowest_mm) / spacing_mm;
    return first_at_support ? 1 + above : count - above;
  }

  /// The slice to open for it.
  int nearest(double slice) const {
    return std::clamp(static_cast<int>(std::lround(slice)), 1, std::max(1, count));
  }

  /// Height of a slice's middle.
  double height_of(double slice) const {
    return lowest_mm + spacing_mm * (first_at_support ? slice - 1 : count - slice);
  }
};

}  // namespace mammotwin
