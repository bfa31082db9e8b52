#pragma once

#include <optional>
#include <vector>

#include "registration/mammogram/upright_image.h"

namespace mammotwin {

/// Front edge of the pectoral muscle in an upright mammogram.
struct PectoralEdge {
  /// (depth, row) [mm] from the image's top to where the edge is last seen; curved.
  std::vector<Eigen::Vector2d> points;
  /// Straight: (depth, row) at the image's top and at the chest wall or the image's bottom.
  Eigen::Vector2d top, end;
  double sd_mm = 0;     ///< of a point on it, across it
  double evidence = 0;  ///< log-likelihood by which it is preferred to no edge
};

/// Looks for the edge across which muscle (bright) changes to breast (darker): a straight line at 6
/// to 45 degrees to the chest wall (of 1,463 radiologists' lines: 22 with a standard deviation of
/// 6), every piece of 6 mm of which is one observation that counts no more than it would if it
/// were clear; then curved, by at most 8 mm. The standard deviation is that of all lines weighed by
/// their likelihood, times what errors were of it. `smooth`: blurred by about a millimetre; `mask`:
/// the breast. Empty where no line is better than none.
std::optional<PectoralEdge> pectoral_edge(const UprightImage& smooth, const MammogramImage& mask);

}  // namespace mammotwin
