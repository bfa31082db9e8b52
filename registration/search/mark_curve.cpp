#include "registration/search/mark_curve.h"

namespace mammotwin {

MarkCurve mark_curve(const ViewRays& marked, const Eigen::Vector2d& on_detector,
                     const ViewRays& other, const ViewUncertainty* uncertainty) {
  constexpr double probability = 0.9;
  MarkCurve curve{marked.curve(on_detector), {}};
  for (const RayPoint& p : curve.on_ray) {
    curve.in_other.push_back({other.project(p.point), {}});
    if (uncertainty)
      curve.in_other.back().ellipse =
          search_ellipse(detector_covariance(*uncertainty, other.compressed(), other.view(),
                                             other.detector(), p.point),
                         probability);
  }
  return curve;
}

}  // namespace mammotwin
