#pragma once

#include <Eigen/Core>
#include <optional>

#include "registration/view/tomosynthesis_slices.h"

namespace mammotwin {

enum class ImageEdge { left, right };

/// The stored image on the detector. Pixel coordinates are (column, row), zero at the centre of the
/// first pixel, rows downwards.
struct PixelGrid {
  double spacing_mm = 0;  ///< on the detector (ImagerPixelSpacing), square
  int columns = 0;
  int rows = 0;
  ImageEdge chest_wall = ImageEdge::left;  ///< image edge on which the detector's edge lies
  bool lateral_at_top = true;              ///< as mammograms are hung; false: lateral downwards
};

/// A source so far away that its rays are parallel, as the slices of a volume are stacked [mm].
inline constexpr double kParallel_mm = 1e7;

/// Cone-beam geometry of a view. Detector coordinates [mm] are (u, v) in the detector's plane from
/// the middle of its chest-wall edge: u along the view's depth, v along its lateral axis. The
/// source stands above that edge's middle, so rays there are vertical and the field is half a cone.
struct Detector {
  double source_distance_mm = 660;  ///< source to detector plane (DistanceSourceToDetector)
  double support_gap_mm = 0;        ///< detector plane to support surface: real ones 10 to 20
  std::optional<PixelGrid> pixels;  ///< absent: positions in mm only
  std::optional<TomosynthesisSlices> slices{};  ///< of a tomosynthesis volume

  /// Point in the view frame -> (u, v). Magnification M = D / (D - gap - height).
  /// Throws std::invalid_argument at or above the source.
  Eigen::Vector2d project(const Eigen::Vector3d& x_in_view) const;

  /// The point at that height [mm above the support] on the ray through (u, v).
  Eigen::Vector3d point_on_ray(const Eigen::Vector2d& on_detector, double height) const;

  Eigen::Vector3d source_in_view() const { return {0, 0, source_distance_mm - support_gap_mm}; }

  /// Both throw std::logic_error without a pixel grid.
  Eigen::Vector2d image_from_detector(const Eigen::Vector2d& on_detector) const;
  Eigen::Vector2d detector_from_image(const Eigen::Vector2d& column_row) const;

  /// How far (u, v) lies beside the image [mm]; 0 in it, and without a pixel grid.
  double beside_image_mm(const Eigen::Vector2d& on_detector) const;
};

/// Throws std::invalid_argument naming the field unless distances are plausible: source 300 to
/// 1500 mm or kParallel_mm, gap 0 to 50 mm, pixel spacing 0.01 to 2 mm, at least one column and
/// row.
void check_detector(const Detector& detector);

}  // namespace mammotwin
