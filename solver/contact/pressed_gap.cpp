#include "solver/contact/pressed_gap.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace mammotwin {

namespace {

using Eigen::Vector2d;

constexpr double kFacing = 0.5;   // cosine: skin that turns away by 60 degrees looks aside
constexpr double kOnHull = 1e-9;  // [mm²] of rounding

struct FacingPoint {
  Vector2d place;  ///< along the plate [mm]
  WeighedGap weighed;
};

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

void add_facing_points(const Face& face, const SolidElement::Coefficients& x, const Plate& plate,
                       std::vector<FacingPoint>& points) {
  for (int q = 0; q < face.num_points(); ++q) {
    const auto y = face.deformed(x, q);
    const SurfacePoint& point = face.point(q);
    const Eigen::Vector3d across = y.segment<3>(3).cross(y.segment<3>(6)),
                          reference = point.A1.cross(point.A2);
    const double sign = reference.dot(point.normal) > 0 ? 1 : -1;
    const Gap gap = plate.gap(y.head<3>());
    if (sign * across.normalized().dot(gap.normal) > -kFacing) continue;
    points.push_back({plate.to_local(y.head<3>()).head<2>(),
                      {gap.gap, across.norm() / reference.norm() * point.area}});
  }
}

/// Counter-clockwise, by Andrew's monotone chain; a point or a line where there is no area.
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vector2d> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Vector2d& p : points) {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

bool is_within(const Vector2d& p, const std::vector<Vector2d>& hull) {
  for (std::size_t k = 0; k < hull.size(); ++k)
    if (cross(hull[(k + 1) % hull.size()] - hull[k], p - hull[k]) < -kOnHull) return false;
  return hull.size() > 2;
}

}  // namespace

std::vector<WeighedGap> pressed_gaps(const Model& model, const State& state, const Plate& plate,
                                     const FaceList& faces, int points1d) {
  std::vector<FacingPoint> points;
  for (const auto& [e, number] : faces) {
    const auto x = model.coefficients(state.x, e);
    for (const Face& face : model.faces(e))
      if (face.face() == number && face.points1d() == points1d)
        add_facing_points(face, x, plate, points);
  }
  std::vector<Vector2d> touching;
  for (const FacingPoint& point : points)
    if (point.weighed.gap <= 0) touching.push_back(point.place);
  const std::vector<Vector2d> hull = convex_hull(std::move(touching));
  std::vector<WeighedGap> gaps;
  for (const FacingPoint& point : points)
    if (is_within(point.place, hull)) gaps.push_back(point.weighed);
  return gaps;
}

double gap_percentile(std::vector<WeighedGap> gaps, double share) {
  std::sort(gaps.begin(), gaps.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; });
  double area = 0;
  for (const WeighedGap& g : gaps) area += g.area;
  double under = 0;
  for (const WeighedGap& g : gaps)
    if ((under += g.area) >= share * area) return g.gap;
  return 0;
}

}  // namespace mammotwin
