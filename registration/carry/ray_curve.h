#pragma once

#include <optional>
#include <vector>

#include "fitting/mesh/inverse_map.h"
#include "registration/view/compressed_view.h"
#include "registration/view/detector.h"

namespace mammotwin {

/// Where the ray to a mark passes the breast at one height above the support.
struct RayPoint {
  double height_mm = 0;
  MeshPoint point;
  Eigen::Vector3d prone_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
};

/// From marks on one view's detector back into the prone MRI. Const queries are thread-safe.
class ViewRays {
 public:
  /// Both meshes have the same elements; the view's frame is that of `compressed`.
  ViewRays(HermiteMesh prone, HermiteMesh compressed, CompressedView view, Detector detector);

  /// The curve in the prone MRI on which the tissue seen at (u, v) lies, from the support up, in
  /// steps of height; empty where the ray meets no breast.
  std::vector<RayPoint> curve(const Eigen::Vector2d& on_detector, double step_mm = 1) const;

  /// The curve's point at one height; nothing outside the breast.
  std::optional<RayPoint> at_height(const Eigen::Vector2d& on_detector, double height,
                                    const std::optional<MeshPoint>& guess = {}) const;

  /// d prone / d height along the ray at one of its points [-].
  Eigen::Vector3d slope(const Eigen::Vector2d& on_detector, const RayPoint& at) const;

  /// (u, v) of a material point.
  Eigen::Vector2d project(const MeshPoint& point) const;

  const CompressedView& view() const { return view_; }
  const Detector& detector() const { return detector_; }
  const HermiteMesh& compressed() const { return compressed_; }

 private:
  HermiteMesh prone_, compressed_;
  InverseMap inverse_;
  CompressedView view_;
  Detector detector_;
  double lowest_mm_ = 0, highest_mm_ = 0;  ///< heights that tissue reaches
};

/// Where a search ellipse round a mark lies in the prone MRI, for tissue at a lesion's height above
/// the support: points of its rim that meet the breast [mm], in order.
std::vector<Eigen::Vector3d> ellipse_in_prone(const ViewRays& view, const Eigen::Vector2d& middle,
                                              const std::vector<Eigen::Vector2d>& rim,
                                              double height_mm);

/// A mark on one view as the other view can see it: the curve's (u, v) there, by height.
std::vector<Eigen::Vector2d> curve_in_other_view(const ViewRays& marked,
                                                 const Eigen::Vector2d& on_detector,
                                                 const ViewRays& other, double step_mm = 1);

/// Where two marks of one lesion put it in the prone MRI.
struct ClosestApproach {
  Eigen::Vector3d prone_in_lps = Eigen::Vector3d::Zero();  ///< midway between the two curves [mm]
  double gap_mm = 0;  ///< distance of the curves there; large: the marks are not of one lesion
};

/// Nearest points of the two marks' curves; nothing if a ray meets no breast.
std::optional<ClosestApproach> closest_approach(const ViewRays& a, const Eigen::Vector2d& mark_a,
                                                const ViewRays& b, const Eigen::Vector2d& mark_b);

/// The same from curves that are there, in steps of a few millimetres at most.
std::optional<ClosestApproach> closest_approach(const ViewRays& a, const Eigen::Vector2d& mark_a,
                                                const std::vector<RayPoint>& curve_a,
                                                const ViewRays& b, const Eigen::Vector2d& mark_b,
                                                const std::vector<RayPoint>& curve_b);

}  // namespace mammotwin
