#pragma once

#include <optional>
#include <vector>

#include "registration/carry/ray_curve.h"
#include "registration/search/search_ellipse.h"

namespace mammotwin {

/// What the other view shows of a point on a mark's ray.
struct SeenPoint {
  Eigen::Vector2d on_detector = Eigen::Vector2d::Zero();  ///< (u, v) [mm]
  std::optional<SearchEllipse> ellipse;                   ///< 90 % round it
};

/// A mark's curve in steps of height of 1 mm: in the prone MRI, and point by point in the other
/// view.
struct MarkCurve {
  std::vector<RayPoint> on_ray;
  std::vector<SeenPoint> in_other;
};

/// `uncertainty`: of the other view; null: no ellipses.
MarkCurve mark_curve(const ViewRays& marked, const Eigen::Vector2d& on_detector,
                     const ViewRays& other, const ViewUncertainty* uncertainty);

}  // namespace mammotwin
