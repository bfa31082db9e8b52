#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "pipeline/report/drawing/picture.h"

namespace mammotwin {

/// Triangles drawn nearest-first into pixels, without a graphics card. x to the right, y up, z
/// towards the eye, in mm; parallel projection.
class DepthImage {
 public:
  DepthImage(int width, int height, const Eigen::Vector2d& lower_left, double pixel_mm);

  void triangle(const std::array<Eigen::Vector3d, 3>& x, const Colour& colour);
  const Raster& raster() const { return raster_; }
  /// Pixel coordinates of a point, from the upper left corner.
  Eigen::Vector2d pixel(const Eigen::Vector3d& x) const;

 private:
  Raster raster_;
  std::vector<double> nearest_;
  Eigen::Vector2d lower_left_;
  double pixel_mm_;
};

}  // namespace mammotwin
