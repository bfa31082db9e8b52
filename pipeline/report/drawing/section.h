#pragma once

#include <Eigen/Geometry>
#include <functional>

#include "pipeline/report/drawing/picture.h"

namespace mammotwin {

/// An axis of space as it runs over the paper.
struct PaperAxis {
  int axis;               ///< 0, 1, 2
  bool reversed = false;  ///< towards smaller coordinates
};

/// A plane normal to one axis, cut to a window, and how it lies on paper. Coordinates are mm of
/// whichever frame the section is of: patient LPS or a view's (depth, lateral, height).
struct Section {
  int normal = 2;
  double at = 0;  ///< coordinate along `normal` [mm]
  PaperAxis right{0}, down{1};
  Eigen::AlignedBox3d window;

  double width_mm() const { return window.sizes()[right.axis]; }
  double height_mm() const { return window.sizes()[down.axis]; }

  /// From the window's upper left corner [mm]; any point, seen along the normal.
  Eigen::Vector2d on_paper(const Eigen::Vector3d& x) const;
  Eigen::Vector3d in_space(const Eigen::Vector2d& on_paper) const;

  /// Colours sampled at pixel centres `pixel_mm` apart.
  Raster sample(double pixel_mm, const std::function<Colour(const Eigen::Vector3d&)>& colour) const;
};

}  // namespace mammotwin
