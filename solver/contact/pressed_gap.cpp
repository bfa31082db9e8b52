#include "solver/contact/pressed_gap.h"

#include <CGAL/Alpha_shape_2.h>
#include <CGAL/Alpha_shape_face_base_2.h>
#include <CGAL/Alpha_shape_vertex_base_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace mammotwin {

namespace {

using Eigen::Vector2d;

constexpr double kFacing = 0.5;  // cosine: skin that turns away by 60 degrees looks aside
constexpr double kPocket = 15;   // [mm], radius, and depth: what is deeper is behind a fold

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Alpha_shape_vertex_base_2<Kernel>;
using Triangle = CGAL::Alpha_shape_face_base_2<Kernel>;
using AlphaShape = CGAL::Alpha_shape_2<
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Triangle>>>;

struct FacingPoint {
  Vector2d place;  ///< along the plate [mm]
  WeighedGap weighed;
};

Kernel::Point_2 cgal_point(const Vector2d& p) { return {p.x(), p.y()}; }

void add_facing_points(const Face& face, const SolidElement::Coefficients& x, const Plate& plate,
                       std::vector<FacingPoint>& points) {
  for (int q = 0; q < face.num_points(); ++q) {
    const auto y = face.deformed(x, q);
    const SurfacePoint& point = face.point(q);
    const Eigen::Vector3d across = y.segment<3>(3).cross(y.segment<3>(6)),
                          reference = point.A1.cross(point.A2);
    const double sign = reference.dot(point.normal) > 0 ? 1 : -1;
    const Gap gap = plate.gap(y.head<3>());
    if (sign * across.normalized().dot(gap.normal) > -kFacing || gap.gap > kPocket) continue;
    const Eigen::Vector3d local = plate.to_local(y.head<3>());
    if (!plate.endless && local.x() < 0) continue;
    points.push_back({local.head<2>(), {gap.gap, across.norm() / reference.norm() * point.area}});
  }
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
  std::vector<Kernel::Point_2> touching;
  for (const FacingPoint& point : points)
    if (point.weighed.gap <= 0) touching.push_back(cgal_point(point.place));
  AlphaShape pressed(touching.begin(), touching.end(), kPocket * kPocket);
  if (pressed.dimension() < 2) return {};
  std::vector<WeighedGap> gaps;
  for (const FacingPoint& point : points)
    if (pressed.classify(cgal_point(point.place)) != AlphaShape::EXTERIOR)
      gaps.push_back(point.weighed);
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
