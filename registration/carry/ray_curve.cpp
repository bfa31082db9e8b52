#include "registration/carry/ray_curve.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>

#include "registration/carry/position_grid.h"

namespace mammotwin {
namespace {

/// Steps of height [mm] of the search that starts the refinement: curves bend over centimetres.
constexpr double kSearchStep_mm = 3;
constexpr int kRefinements = 20;
constexpr double kConverged_mm = 1e-9;

struct Pair {
  RayPoint a, b;
  double squared_distance = std::numeric_limits<double>::infinity();
};

Pair nearest_samples(const std::vector<RayPoint>& a, const std::vector<RayPoint>& b) {
  Pair best;
  for (const RayPoint& p : a)
    for (const RayPoint& q : b) {
      const double d = (p.prone_in_lps - q.prone_in_lps).squaredNorm();
      if (d < best.squared_distance) best = {p, q, d};
    }
  return best;
}

/// Gauss-Newton step of both heights for the least distance of the curves' tangents.
Eigen::Vector2d height_step(const Pair& pair, const Eigen::Vector3d& slope_a,
                            const Eigen::Vector3d& slope_b) {
  Eigen::Matrix<double, 3, 2> jacobian;
  jacobian << slope_a, -slope_b;
  const Eigen::Vector3d residual = pair.a.prone_in_lps - pair.b.prone_in_lps;
  // Parallel tangents leave one direction free: a small multiple of 1 keeps the step finite.
  const Eigen::Matrix2d normal =
      jacobian.transpose() * jacobian + 1e-9 * Eigen::Matrix2d::Identity();
  return normal.inverse() * (-jacobian.transpose() * residual);
}

}  // namespace

ViewRays::ViewRays(HermiteMesh prone, HermiteMesh compressed, CompressedView view,
                   Detector detector)
    : prone_(std::move(prone)),
      compressed_(std::move(compressed)),
      inverse_(compressed_),
      view_(std::move(view)),
      detector_(std::move(detector)) {
  const Eigen::AlignedBox3d box = bounding_box(in_view_frame(compressed_, view_.frame));
  lowest_mm_ = box.min().z();
  highest_mm_ = box.max().z();
}

std::optional<RayPoint> ViewRays::at_height(const Eigen::Vector2d& on_detector, double height,
                                            const std::optional<MeshPoint>& guess) const {
  const Eigen::Vector3d x = view_.frame.lps_from_view(detector_.point_on_ray(on_detector, height));
  const auto point = guess ? inverse_.locate(x, *guess) : inverse_.locate(x);
  if (!point) return std::nullopt;
  return RayPoint{height, *point, prone_.position(*point)};
}

std::vector<RayPoint> ViewRays::curve(const Eigen::Vector2d& on_detector, double step_mm) const {
  std::vector<RayPoint> points;
  std::optional<MeshPoint> guess;
  for (double height = lowest_mm_; height <= highest_mm_; height += step_mm) {
    const auto found = at_height(on_detector, height, guess);
    guess.reset();
    if (!found) continue;
    guess = found->point;
    points.push_back(*found);
  }
  return points;
}

Eigen::Vector3d ViewRays::slope(const Eigen::Vector2d& on_detector, const RayPoint& at) const {
  const Eigen::Vector3d ray =
      view_.frame.axes.transpose() *
      (detector_.point_on_ray(on_detector, 1) - detector_.point_on_ray(on_detector, 0));
  return prone_.jacobian(at.point) * compressed_.jacobian(at.point).inverse() * ray;
}

Eigen::Vector2d ViewRays::project(const MeshPoint& point) const {
  return detector_.project(view_.frame.view_from_lps(compressed_.position(point)));
}

std::vector<Eigen::Vector3d> ellipse_in_prone(const ViewRays& view, const Eigen::Vector2d& middle,
                                              const std::vector<Eigen::Vector2d>& rim,
                                              double height_mm) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector2d& off : rim)
    if (const auto found = view.at_height(middle + off, height_mm))
      points.push_back(found->prone_in_lps);
  return points;
}

std::vector<Eigen::Vector2d> curve_in_other_view(const ViewRays& marked,
                                                 const Eigen::Vector2d& on_detector,
                                                 const ViewRays& other, double step_mm) {
  std::vector<Eigen::Vector2d> curve;
  for (const RayPoint& p : marked.curve(on_detector, step_mm))
    curve.push_back(other.project(p.point));
  return curve;
}

std::optional<ClosestApproach> closest_approach(const ViewRays& a, const Eigen::Vector2d& mark_a,
                                                const ViewRays& b, const Eigen::Vector2d& mark_b) {
  return closest_approach(a, mark_a, a.curve(mark_a, kSearchStep_mm), b, mark_b,
                          b.curve(mark_b, kSearchStep_mm));
}

std::optional<ClosestApproach> closest_approach(const ViewRays& a, const Eigen::Vector2d& mark_a,
                                                const std::vector<RayPoint>& curve_a,
                                                const ViewRays& b, const Eigen::Vector2d& mark_b,
                                                const std::vector<RayPoint>& curve_b) {
  Pair best = nearest_samples(curve_a, curve_b);
  if (std::isinf(best.squared_distance)) return std::nullopt;
  for (int i = 0; i < kRefinements; ++i) {
    Eigen::Vector2d step = height_step(best, a.slope(mark_a, best.a), b.slope(mark_b, best.b));
    bool improved = false;
    for (int halvings = 0; halvings < 8 && !improved; ++halvings, step /= 2) {
      const auto p = a.at_height(mark_a, best.a.height_mm + step.x(), best.a.point);
      const auto q = b.at_height(mark_b, best.b.height_mm + step.y(), best.b.point);
      if (!p || !q) continue;
      const double d = (p->prone_in_lps - q->prone_in_lps).squaredNorm();
      improved = d < best.squared_distance;
      if (improved) best = {*p, *q, d};
    }
    if (!improved || step.norm() < kConverged_mm) break;
  }
  return ClosestApproach{(best.a.prone_in_lps + best.b.prone_in_lps) / 2,
                         std::sqrt(best.squared_distance)};
}

}  // namespace mammotwin
