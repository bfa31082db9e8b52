#include "registration/search/silhouette.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace mammotwin {
namespace {

constexpr int kNetPoints = 9;  // along a face's side: nets of 3 mm on faces of 25 mm
constexpr double kStepDeg = 3, kFirstDeg = -75;

double angle_deg(const Eigen::Vector2d& from_centre) {
  return std::atan2(from_centre.y(), from_centre.x()) * 180 / std::numbers::pi;
}

/// Rays that a segment crosses, with the distance of each crossing.
template <class Visit>
void for_each_crossing(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Visit& visit) {
  double low = angle_deg(p), high = angle_deg(q);
  if (low > high) std::swap(low, high);
  if (high - low > 90) return;  // behind the centre
  const int first = std::max(0, static_cast<int>(std::ceil((low - kFirstDeg) / kStepDeg)));
  const int last = std::min(kRays - 1, static_cast<int>(std::floor((high - kFirstDeg) / kStepDeg)));
  for (int ray = first; ray <= last; ++ray) {
    const Eigen::Vector2d d = ray_direction(ray);
    const auto aside = [&](const Eigen::Vector2d& x) { return d.x() * x.y() - d.y() * x.x(); };
    const double a = aside(p), b = aside(q);
    const double t = a == b ? 0 : a / (a - b);
    visit(ray, (p + t * (q - p)).dot(d));
  }
}

/// ξ of point (i, j) of a face's net.
Eigen::Vector3d net_point(int face, int i, int j) {
  Eigen::Vector3d xi;
  const int normal = face / 2;
  xi[normal] = face % 2;
  xi[(normal + 1) % 3] = i / (kNetPoints - 1.0);
  xi[(normal + 2) % 3] = j / (kNetPoints - 1.0);
  return xi;
}

template <class Visit>
void for_each_outer_face(const std::vector<FaceLabels>& faces, const Visit& visit) {
  for (std::size_t e = 0; e < faces.size(); ++e)
    for (int face = 0; face < 6; ++face)
      if (faces[e][face] == FaceLabel::skin || faces[e][face] == FaceLabel::cut)
        visit(static_cast<int>(e), face, faces[e][face] == FaceLabel::skin);
}

std::vector<MeshPoint> net_points(const std::vector<FaceLabels>& faces) {
  std::vector<MeshPoint> points;
  for_each_outer_face(faces, [&](int e, int face, bool) {
    for (int j = 0; j < kNetPoints; ++j)
      for (int i = 0; i < kNetPoints; ++i) points.push_back({e, net_point(face, i, j)});
  });
  return points;
}

}  // namespace

Eigen::Vector2d ray_direction(int ray) {
  const double t = (kFirstDeg + ray * kStepDeg) * std::numbers::pi / 180;
  return {std::cos(t), std::sin(t)};
}

RayDistances distances_along_rays(const std::vector<Eigen::Vector2d>& line,
                                  const Eigen::Vector2d& centre) {
  RayDistances far(kRays);
  for (std::size_t n = 0; n + 1 < line.size(); ++n)
    for_each_crossing(line[n] - centre, line[n + 1] - centre, [&](int ray, double distance) {
      if (!far[ray] || distance > *far[ray]) far[ray] = distance;
    });
  return far;
}

Silhouette::Silhouette(const ReducedView& view, const std::vector<FaceLabels>& faces)
    : samples_(view, net_points(faces)) {
  int first = 0;
  for_each_outer_face(faces, [&](int, int, bool skin) {
    for (int j = 0; j < kNetPoints; ++j)
      for (int i = 0; i < kNetPoints; ++i) {
        const int here = first + j * kNetPoints + i;
        if (i + 1 < kNetPoints) lines_.push_back({here, here + 1, skin});
        if (j + 1 < kNetPoints) lines_.push_back({here, here + kNetPoints, skin});
      }
    first += kNetPoints * kNetPoints;
  });
}

RayDistances Silhouette::at(const ReducedView& view, const ViewState& z, const Detector& detector,
                            const Eigen::Vector2d& centre) const {
  const ViewSamples::Points x = samples_.at(view, z);
  Eigen::Matrix2Xd uv(2, x.cols());
  for (Eigen::Index n = 0; n < x.cols(); ++n) uv.col(n) = detector.project(x.col(n)) - centre;
  std::vector<double> far(kRays, -1);
  std::vector<bool> skin(kRays, false);
  for (const Line& line : lines_)
    for_each_crossing(uv.col(line.a), uv.col(line.b), [&](int ray, double distance) {
      if (distance <= far[ray]) return;
      far[ray] = distance;
      skin[ray] = line.skin;
    });
  RayDistances result(kRays);
  for (int ray = 0; ray < kRays; ++ray)
    if (skin[ray]) result[ray] = far[ray];
  return result;
}

}  // namespace mammotwin
