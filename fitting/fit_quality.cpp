#include "fitting/fit_quality.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fitting/mesh/inverse_map.h"
#include "fitting/surface/closest_point.h"

namespace mammotwin {

namespace {

// Triangles of about 1 to 2 mm: their sagitta on a nipple of 5 mm radius is 0.05 mm.
constexpr int face_divisions = 20;

constexpr double landmark_reach_mm = 15;  // a nipple with its areola's rim

struct Distances {
  std::vector<double> values, weights;
};

Distances distances(const TriangleSurface& from, const ClosestPoint& to) {
  Distances d{std::vector<double>(from.vertices.size()), from.vertex_areas()};
  tbb::parallel_for(std::size_t{0}, from.vertices.size(), [&](std::size_t v) {
    d.values[v] = (to(from.vertices[v]).x - from.vertices[v]).norm();
  });
  return d;
}

double rms(const Distances& d) {
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < d.values.size(); ++i) {
    sum += d.weights[i] * d.values[i] * d.values[i];
    weights += d.weights[i];
  }
  return std::sqrt(sum / weights);
}

double quantile(const Distances& d, double share) {
  std::vector<std::size_t> order(d.values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return d.values[a] < d.values[b]; });
  const double total = std::accumulate(d.weights.begin(), d.weights.end(), 0.0);
  double sum = 0;
  for (std::size_t i : order) {
    sum += d.weights[i];
    if (sum >= share * total) return d.values[i];
  }
  return d.values[order.back()];
}

}  // namespace

SurfaceDistances surface_distances(const HermiteMesh& mesh, const std::vector<FaceLabels>& faces,
                                   FaceLabel label, const TriangleSurface& data,
                                   const Eigen::Vector3d& landmark) {
  const TriangleSurface own = face_mesh(mesh, faces, label, face_divisions).surface;
  const Distances to_data = distances(own, ClosestPoint(data));
  const Distances to_mesh = distances(data, ClosestPoint(own));
  SurfaceDistances result{rms(to_data),
                          rms(to_mesh),
                          std::max(quantile(to_data, 0.95), quantile(to_mesh, 0.95)),
                          0,
                          0,
                          Eigen::Vector3d::Zero()};
  const auto consider = [&](const Distances& d, const TriangleSurface& surface) {
    for (std::size_t v = 0; v < d.values.size(); ++v)
      if ((surface.vertices[v] - landmark).norm() < landmark_reach_mm)
        result.max_at_landmark = std::max(result.max_at_landmark, d.values[v]);
    const auto at = std::max_element(d.values.begin(), d.values.end());
    if (*at <= result.max) return;
    result.max = *at;
    result.farthest = surface.vertices[at - d.values.begin()];
  };
  consider(to_data, own);
  consider(to_mesh, data);
  return result;
}

PointField skin_distance_field(const MeshFile& file, const TriangleSurface& data) {
  const ClosestPoint closest(data);
  return interpolate_field(file.mesh, [&](const MeshPoint& p) {
    if (p.xi.z() < 1 || file.faces[p.element][5] != FaceLabel::skin) return 0.0;
    const Eigen::Vector3d x = file.mesh.position(p);
    const ClosestPoint::Hit hit = closest(x);
    return std::copysign((x - hit.x).norm(), (x - hit.x).dot(hit.normal));
  });
}

double rms_to_faces(const HermiteMesh& mesh, const std::vector<FaceLabels>& faces, FaceLabel label,
                    const std::vector<Eigen::Vector3d>& points) {
  if (points.empty()) return 0;
  const ClosestPoint closest(face_mesh(mesh, faces, label, face_divisions).surface);
  std::vector<double> squared(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    squared[i] = (closest(points[i]).x - points[i]).squaredNorm();
  });
  return std::sqrt(std::accumulate(squared.begin(), squared.end(), 0.0) / points.size());
}

Coverage coverage(const HermiteMesh& mesh, const Volume<std::uint8_t>& labels,
                  const BreastRegion& region) {
  const InverseMap map(mesh);
  struct Count {
    long breast = 0, breast_inside = 0, lesion = 0, lesion_inside = 0;
  };
  std::vector<Count> counts(labels.size.z());
  tbb::parallel_for(0, labels.size.z(), [&](int k) {
    Count& count = counts[k];
    for (int i = 0; i < labels.size.x(); ++i) {
      const bool in_region = region.contains(labels.position(i, 0, k));
      MeshPoint guess{0, Eigen::Vector3d::Constant(0.5)}, last{-1, guess.xi};
      for (int j = 0; j < labels.size.y(); ++j) {
        const std::uint8_t value = labels(i, j, k);
        if (!label::is_breast(value)) {
          if (value == label::muscle) break;
          continue;
        }
        if (!in_region && !label::is_lesion(value)) continue;
        const auto found = map.locate(labels.position(i, j, k), guess);
        if (found) {
          // Two in a row show where the next one is.
          guess = {found->element,
                   found->element == last.element ? 2 * found->xi - last.xi : found->xi};
          last = *found;
        }
        count.breast += in_region;
        count.breast_inside += in_region && found.has_value();
        if (label::is_lesion(value)) {
          ++count.lesion;
          count.lesion_inside += found.has_value();
        }
      }
    }
  });
  Count sum;
  for (const Count& c : counts) {
    sum.breast += c.breast;
    sum.breast_inside += c.breast_inside;
    sum.lesion += c.lesion;
    sum.lesion_inside += c.lesion_inside;
  }
  return {sum.breast ? static_cast<double>(sum.breast_inside) / sum.breast : 0,
          sum.lesion ? static_cast<double>(sum.lesion_inside) / sum.lesion : 1};
}

}  // namespace mammotwin
