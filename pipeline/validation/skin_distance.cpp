#include "pipeline/validation/skin_distance.h"

#include <algorithm>
#include <cmath>

#include "fitting/surface/closest_point.h"
#include "fitting/surface/face_mesh.h"

namespace mammotwin {
namespace {

constexpr int kDivisions = 20;  // of an element's side, which is 15 to 30 mm
constexpr int kHalfRays = 60;   // one a degree
constexpr double kDegree = 3.14159265358979 / 180;

/// Mean square distance of a surface's vertices to another, by area.
double mean_square(const TriangleSurface& from, const TriangleSurface& to) {
  const ClosestPoint closest(to);
  const std::vector<double> areas = from.vertex_areas();
  double sum = 0, area = 0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    sum += areas[v] * (closest(from.vertices[v]).x - from.vertices[v]).squaredNorm();
    area += areas[v];
  }
  return sum / area;
}

/// How far along `ray` from `centre` it crosses the segment from a to b; 0 where it does not.
double crossing(const Eigen::Vector2d& centre, const Eigen::Vector2d& ray, const Eigen::Vector2d& a,
                const Eigen::Vector2d& b) {
  const auto cross = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return p.x() * q.y() - p.y() * q.x();
  };
  const double side_a = cross(ray, a - centre), side_b = cross(ray, b - centre);
  if (side_a * side_b > 0 || side_a == side_b) return 0;
  const Eigen::Vector2d at = a + side_a / (side_a - side_b) * (b - a);
  return (at - centre).dot(ray);
}

}  // namespace

TriangleSurface skin_surface(const MeshFile& file) {
  return face_mesh(file.mesh, file.faces, FaceLabel::skin, kDivisions).surface;
}

double rms_distance(const std::vector<Eigen::Vector3d>& points, const TriangleSurface& surface) {
  const ClosestPoint closest(surface);
  double squares = 0;
  for (const auto& x : points) squares += (closest(x).x - x).squaredNorm();
  return std::sqrt(squares / static_cast<double>(points.size()));
}

double rms_distance(const TriangleSurface& a, const TriangleSurface& b) {
  return std::sqrt(std::max(mean_square(a, b), mean_square(b, a)));
}

std::vector<double> side_outline(const TriangleSurface& skin, const Eigen::Vector2d& centre) {
  std::vector<double> outline;
  for (int degrees = -kHalfRays; degrees <= kHalfRays; ++degrees) {
    const Eigen::Vector2d ray(-std::cos(degrees * kDegree), std::sin(degrees * kDegree));
    double farthest = 0;
    for (const auto& t : skin.triangles)
      for (int edge = 0; edge < 3; ++edge)
        farthest = std::max(farthest, crossing(centre, ray, skin.vertices[t[edge]].tail<2>(),
                                               skin.vertices[t[(edge + 1) % 3]].tail<2>()));
    outline.push_back(farthest);
  }
  return outline;
}

}  // namespace mammotwin
