#include "fitting/surface/triangle_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace mammotwin {

namespace {

using Eigen::Vector3d;
using Edge = std::pair<int, int>;

Edge edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Keeps the triangles chosen and the vertices that they use.
TriangleSurface subset(const TriangleSurface& surface, const std::vector<bool>& keep) {
  TriangleSurface part;
  std::vector<int> index(surface.vertices.size(), -1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!keep[t]) continue;
    auto triangle = surface.triangles[t];
    for (int& v : triangle) {
      if (index[v] < 0) {
        index[v] = static_cast<int>(part.vertices.size());
        part.vertices.push_back(surface.vertices[v]);
      }
      v = index[v];
    }
    part.triangles.push_back(triangle);
  }
  return part;
}

/// Cuts triangles at a plane; signed heights are 0 for vertices on it.
class Clipper {
 public:
  Clipper(TriangleSurface& surface, std::vector<double>& height)
      : surface_(surface), height_(height) {}

  std::vector<std::array<int, 3>> run() {
    std::vector<std::array<int, 3>> kept;
    for (const auto& triangle : surface_.triangles) {
      const std::vector<int> polygon = above(triangle);
      for (std::size_t i = 2; i < polygon.size(); ++i)
        kept.push_back({polygon[0], polygon[i - 1], polygon[i]});
    }
    return kept;
  }

 private:
  std::vector<int> above(const std::array<int, 3>& triangle) {
    const auto below = [this](int v) { return height_[v] <= 0; };
    if (std::all_of(triangle.begin(), triangle.end(), below)) return {};
    std::vector<int> polygon;
    for (int i = 0; i < 3; ++i) {
      const int a = triangle[i], b = triangle[(i + 1) % 3];
      if (height_[a] >= 0) polygon.push_back(a);
      if (height_[a] * height_[b] < 0) polygon.push_back(crossing(a, b));
    }
    return polygon;
  }

  int crossing(int a, int b) {
    const Edge key = edge(a, b);
    const auto [at, is_new] =
        crossings_.try_emplace(key, static_cast<int>(surface_.vertices.size()));
    if (is_new) {
      const double t = height_[key.first] / (height_[key.first] - height_[key.second]);
      const Vector3d from = surface_.vertices[key.first];  // on one plane with `to`: stays on it
      const Vector3d to = surface_.vertices[key.second];
      surface_.vertices.push_back(from + t * (to - from));
      height_.push_back(0);
    }
    return at->second;
  }

  TriangleSurface& surface_;
  std::vector<double>& height_;
  std::map<Edge, int> crossings_;
};

int root(std::vector<int>& parent, int v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

Vector3d TriangleSurface::area_vector(int triangle) const {
  const auto& t = triangles[triangle];
  return (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]) / 2;
}

std::vector<double> TriangleSurface::vertex_areas() const {
  std::vector<double> areas(vertices.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int v : triangles[t]) areas[v] += area_vector(static_cast<int>(t)).norm() / 3;
  return areas;
}

TriangleSurface clip(const TriangleSurface& surface, int axis, double limit, bool keep_above,
                     double snap) {
  TriangleSurface cut = surface;
  std::vector<double> height;
  for (auto& v : cut.vertices) {
    if (std::abs(v[axis] - limit) < snap) v[axis] = limit;
    height.push_back(keep_above ? v[axis] - limit : limit - v[axis]);
  }
  cut.triangles = Clipper(cut, height).run();
  for (std::size_t v = surface.vertices.size(); v < cut.vertices.size(); ++v)
    cut.vertices[v][axis] = limit;
  return subset(cut, std::vector<bool>(cut.triangles.size(), true));
}

TriangleSurface largest_part(const TriangleSurface& surface) {
  std::vector<int> parent(surface.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& t : surface.triangles)
    for (int i : {1, 2}) parent[root(parent, t[i])] = root(parent, t[0]);
  std::map<int, double> areas;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    areas[root(parent, surface.triangles[t][0])] += surface.area_vector(static_cast<int>(t)).norm();
  int largest = -1;
  double largest_area = 0;
  for (const auto& [part, area] : areas)
    if (area > largest_area) largest = part, largest_area = area;
  std::vector<bool> keep;
  for (const auto& t : surface.triangles) keep.push_back(root(parent, t[0]) == largest);
  return subset(surface, keep);
}

int euler_characteristic(const TriangleSurface& surface) {
  std::vector<Edge> edges;
  for (const auto& t : surface.triangles)
    for (int i = 0; i < 3; ++i) edges.push_back(edge(t[i], t[(i + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  const auto distinct = std::unique(edges.begin(), edges.end()) - edges.begin();
  return static_cast<int>(surface.vertices.size()) - static_cast<int>(distinct) +
         static_cast<int>(surface.triangles.size());
}

std::vector<std::vector<int>> boundary_loops(const TriangleSurface& surface) {
  std::vector<Edge> directed;
  for (const auto& t : surface.triangles)
    for (int i = 0; i < 3; ++i) directed.push_back({t[i], t[(i + 1) % 3]});
  std::sort(directed.begin(), directed.end());
  std::map<int, int> next;
  for (const auto& [a, b] : directed)
    if (!std::binary_search(directed.begin(), directed.end(), Edge{b, a})) next[a] = b;
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    std::vector<int>& loop = loops.emplace_back();
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
      loop.push_back(at->second);
      next.erase(at);
    }
  }
  return loops;
}

}  // namespace mammotwin
