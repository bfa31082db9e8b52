#include "fitting/solve/fit_samples.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

namespace mammotwin {

namespace {

constexpr int skin_samples = 8;  // a side of a face, mesh to data
constexpr int wall_samples = 7;  // a side of a face
// Beyond this the labelled wall is taken for an error (a tumour in the muscle) and loses weight.
constexpr double wall_trust_mm = 10;
// A nipple is a thousandth of the skin: without weight of its own it is smoothed away by 3 to 6 mm.
constexpr double nipple_weight = 20;
constexpr double nipple_width_mm = 10;
constexpr double smallest_distance_mm = 1e-6;  // whose direction is not rounding

/// Coordinate that is constant along edge 0 to 3 (u = 0, u = 1, v = 0, v = 1).
int held_coordinate(int edge) { return edge / 2; }

/// Share of each vertex of a polyline: half the length of its segments over the whole length.
std::vector<double> length_shares(const TriangleSurface& skin, const std::vector<int>& line) {
  std::vector<double> shares(line.size(), 0);
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double length = (skin.vertices[line[i]] - skin.vertices[line[i - 1]]).norm();
    shares[i] += length / 2;
    shares[i - 1] += length / 2;
  }
  const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& s : shares) s /= total;
  return shares;
}

}  // namespace

FitTarget::FitTarget(const Slab& slab, const TriangleSurface& skin, const FlatSkin& flat,
                     const HeightField& wall, const Eigen::Vector3d& nipple)
    : slab_(slab),
      skin_(skin),
      flat_(flat),
      wall_(wall),
      nipple_(nipple),
      closest_(skin),
      areas_(skin.vertex_areas()) {
  const double total = std::accumulate(areas_.begin(), areas_.end(), 0.0);
  for (double& a : areas_) a /= total;
  forget_feet();
}

double FitTarget::importance(const Eigen::Vector3d& x) const {
  return 1 + nipple_weight *
                 std::exp(-(x - nipple_).squaredNorm() / (2 * nipple_width_mm * nipple_width_mm));
}

void FitTarget::forget_feet() {
  const Eigen::Vector2d size(slab_.elements.x(), slab_.elements.y());
  feet_.clear();
  for (const auto& uv : flat_.uv) feet_.push_back(slab_.graded(uv).cwiseProduct(size));
  for (int edge = 0; edge < 4; ++edge) {
    edge_feet_[edge].clear();
    for (int v : flat_.edges[edge]) edge_feet_[edge].push_back(feet_[v]);
  }
}

void FitTarget::weigh_mesh(const HermiteMesh& mesh) {
  const SkinPatches patches(slab_, mesh);
  mesh_shares_.clear();
  for (int m = 0; m < num_mesh_samples(); ++m) {
    const SkinPatches::Point at = patches.at(mesh_sample(m));
    mesh_shares_.push_back(at.by_s.cross(at.by_t).norm());
  }
  const double total = std::accumulate(mesh_shares_.begin(), mesh_shares_.end(), 0.0);
  for (int m = 0; m < num_mesh_samples(); ++m)
    mesh_shares_[m] *= importance(patches.at(mesh_sample(m)).x) / total;
}

int FitTarget::num_mesh_samples() const {
  return slab_.elements.x() * slab_.elements.y() * skin_samples * skin_samples;
}

SkinPatches::Coordinates FitTarget::mesh_sample(int m) const {
  const int nx = slab_.elements.x() * skin_samples;
  return {(m % nx + 0.5) / skin_samples, (m / nx + 0.5) / skin_samples};
}

std::vector<PlaneSample> FitTarget::samples(const HermiteMesh& mesh, const Weights& weights) {
  const SkinPatches patches(slab_, mesh);
  std::vector<PlaneSample> out;
  add_data_to_mesh(patches, weights.all * weights.data_to_mesh, out);
  add_edges(patches, weights.all * weights.edges, out);
  add_mesh_to_data(patches, weights.all * weights.mesh_to_data, out);
  add_wall(mesh, weights.all * weights.wall, out);
  return out;
}

void FitTarget::add_data_to_mesh(const SkinPatches& patches, double weight,
                                 std::vector<PlaneSample>& out) {
  const std::size_t first = out.size();
  out.resize(first + skin_.vertices.size());
  std::vector<double> squared(skin_.vertices.size());
  tbb::parallel_for(std::size_t{0}, skin_.vertices.size(), [&](std::size_t v) {
    feet_[v] = patches.nearest(skin_.vertices[v], feet_[v]);
    const SkinPatches::Point foot = patches.at(feet_[v]);
    squared[v] = areas_[v] * (foot.x - skin_.vertices[v]).squaredNorm();
    out[first + v] = {patches.mesh_point(feet_[v]), foot.normal(), skin_.vertices[v],
                      weight * areas_[v] * importance(skin_.vertices[v])};
  });
  skin_rms_ = std::sqrt(std::accumulate(squared.begin(), squared.end(), 0.0));
}

void FitTarget::add_edges(const SkinPatches& patches, double weight,
                          std::vector<PlaneSample>& out) {
  for (int edge = 0; edge < 4; ++edge) {
    const auto& line = flat_.edges[edge];
    const std::vector<double> shares = length_shares(skin_, line);
    const int held = held_coordinate(edge);
    // The normal of the cut plane: x for u = const, z for v = const.
    const Eigen::Vector3d plane = held == 0 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Eigen::Vector3d& x = skin_.vertices[line[i]];
      auto& st = edge_feet_[edge][i];
      const bool is_corner = i == 0 || i + 1 == line.size();
      if (!is_corner) st = patches.nearest(x, st, held);
      const SkinPatches::Point foot = patches.at(st);
      const Eigen::Vector3d tangent = held == 0 ? foot.by_t : foot.by_s;
      const Eigen::Vector3d normal =
          is_corner ? Eigen::Vector3d::UnitY() : Eigen::Vector3d(plane.cross(tangent).normalized());
      // A corner is one vertex of many; it counts as a twentieth of its edge.
      const double share = is_corner ? 0.05 : shares[i];
      out.push_back({patches.mesh_point(st), normal, x, weight * share / 4});
    }
  }
}

void FitTarget::add_mesh_to_data(const SkinPatches& patches, double weight,
                                 std::vector<PlaneSample>& out) {
  const std::size_t first = out.size();
  out.resize(first + num_mesh_samples());
  tbb::parallel_for(0, num_mesh_samples(), [&](int m) {
    const SkinPatches::Coordinates st = mesh_sample(m);
    const Eigen::Vector3d x = patches.at(st).x;
    const ClosestPoint::Hit hit = closest_(x);
    // Not the triangle's normal where an edge or a corner is nearest: the cost would jump there.
    const Eigen::Vector3d away = x - hit.x;
    const double distance = away.norm();
    const Eigen::Vector3d normal = distance > smallest_distance_mm ? away / distance : hit.normal;
    out[first + m] = {patches.mesh_point(st), normal, hit.x, weight * mesh_shares_[m]};
  });
}

void FitTarget::add_wall(const HermiteMesh& mesh, double weight,
                         std::vector<PlaneSample>& out) const {
  const int faces = slab_.elements.x() * slab_.elements.y();
  const double share = 1.0 / (faces * wall_samples * wall_samples);
  for (int face = 0; face < faces; ++face)
    for (int m = 0; m < wall_samples * wall_samples; ++m) {
      const MeshPoint p{
          face, Eigen::Vector3d(m % wall_samples, m / wall_samples, 0) / (wall_samples - 1)};
      const Eigen::Vector3d x = mesh.position(p);
      const Eigen::Vector2d slope = wall_.slope(x.x(), x.z());
      const Eigen::Vector3d target(x.x(), wall_(x.x(), x.z()), x.z());
      const Eigen::Vector3d normal = Eigen::Vector3d(-slope.x(), 1, -slope.y()).normalized();
      // Cauchy's loss, trust² log(1 + (distance / trust)²), as the square that touches it here.
      const double squared = std::pow(normal.dot(x - target) / wall_trust_mm, 2);
      const double beyond = std::log1p(squared) - squared / (1 + squared);
      out.push_back({p, normal, target, weight * share / (1 + squared),
                     weight * share * wall_trust_mm * wall_trust_mm * beyond});
    }
}

}  // namespace mammotwin
