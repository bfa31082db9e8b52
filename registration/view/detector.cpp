#include "registration/view/detector.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mammotwin {
namespace {

const PixelGrid& need_pixels(const Detector& detector) {
  if (!detector.pixels) throw std::logic_error("detector: pixel positions need a pixel grid");
  return *detector.pixels;
}

void check_range(const char* name, double value, double low, double high, const char* unit) {
  if (value >= low && value <= high) return;
  throw std::invalid_argument("detector: " + std::string(name) + " is " + std::to_string(value) +
                              "; expected " + std::to_string(low) + " to " + std::to_string(high) +
                              " " + unit);
}

}  // namespace

Eigen::Vector2d Detector::project(const Eigen::Vector3d& x_in_view) const {
  const double below_source = source_distance_mm - support_gap_mm - x_in_view.z();
  if (below_source <= 0)
    throw std::invalid_argument("detector: a point " + std::to_string(x_in_view.z()) +
                                " mm above the support is at or above the X-ray source");
  return x_in_view.head<2>() * (source_distance_mm / below_source);
}

Eigen::Vector3d Detector::point_on_ray(const Eigen::Vector2d& on_detector, double height) const {
  const double shrink = (source_distance_mm - support_gap_mm - height) / source_distance_mm;
  return {on_detector.x() * shrink, on_detector.y() * shrink, height};
}

Eigen::Vector2d Detector::image_from_detector(const Eigen::Vector2d& on_detector) const {
  const PixelGrid& grid = need_pixels(*this);
  const double from_edge = on_detector.x() / grid.spacing_mm - 0.5;
  const double from_middle = on_detector.y() / grid.spacing_mm * (grid.lateral_at_top ? -1 : 1);
  return {grid.chest_wall == ImageEdge::left ? from_edge : grid.columns - 1 - from_edge,
          0.5 * (grid.rows - 1) + from_middle};
}

Eigen::Vector2d Detector::detector_from_image(const Eigen::Vector2d& column_row) const {
  const PixelGrid& grid = need_pixels(*this);
  const double from_edge =
      grid.chest_wall == ImageEdge::left ? column_row.x() : grid.columns - 1 - column_row.x();
  const double from_middle = column_row.y() - 0.5 * (grid.rows - 1);
  return {(from_edge + 0.5) * grid.spacing_mm,
          from_middle * grid.spacing_mm * (grid.lateral_at_top ? -1 : 1)};
}

double Detector::beside_image_mm(const Eigen::Vector2d& on_detector) const {
  if (!pixels) return 0;
  const double width = pixels->columns * pixels->spacing_mm,
               half_height = pixels->rows * pixels->spacing_mm / 2;
  const double along = std::max({0.0, -on_detector.x(), on_detector.x() - width});
  const double across = std::max(0.0, std::abs(on_detector.y()) - half_height);
  return std::hypot(along, across);
}

void check_detector(const Detector& detector) {
  if (detector.source_distance_mm != kParallel_mm)
    check_range("source_distance_mm", detector.source_distance_mm, 300, 1500, "mm");
  check_range("support_gap_mm", detector.support_gap_mm, 0, 50, "mm");
  if (detector.slices) {
    check_range("slices.spacing_mm", detector.slices->spacing_mm, 0.1, 20, "mm");
    check_range("slices.count", detector.slices->count, 1, 1000, "slices");
  }
  if (!detector.pixels) return;
  check_range("pixels.spacing_mm", detector.pixels->spacing_mm, 0.01, 2, "mm");
  check_range("pixels.columns", detector.pixels->columns, 1, 100000, "pixels");
  check_range("pixels.rows", detector.pixels->rows, 1, 100000, "pixels");
}

}  // namespace mammotwin
