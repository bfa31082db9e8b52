#include "segmentation/lesion/random_walker.h"

#include <cmath>
#include <vector>

namespace mammotwin {
namespace {

constexpr double beta = 100, least_weight = 1e-5;
constexpr int most_iterations = 400;
constexpr double relative_residual = 1e-5;

struct Edge {
  int a, b;
  double weight;
};

/// The graph of free voxels: Laplacian L p = f, f from the inside seeds.
struct Walk {
  std::vector<int> unknown_of;  ///< of each voxel; -1 where it is none
  std::vector<Edge> edges;      ///< between unknowns
  std::vector<double> diagonal, right_side;
};

Walk build(const Volume<float>& image, const Volume<std::uint8_t>& allowed,
           const Volume<std::uint8_t>& seeds, double range) {
  Walk walk;
  int count = 0;
  for (std::size_t v = 0; v < seeds.values.size(); ++v)
    walk.unknown_of.push_back(allowed.values[v] && seeds.values[v] == walker_free ? count++ : -1);
  walk.diagonal.assign(count, 0);
  walk.right_side.assign(count, 0);
  const auto connect = [&](std::size_t v, std::size_t w) {
    if (!allowed.values[v] || !allowed.values[w]) return;
    const int a = walk.unknown_of[v], b = walk.unknown_of[w];
    if (a < 0 && b < 0) return;
    const double d = (image.values[v] - image.values[w]) / range;
    const double weight = std::exp(-beta * d * d) + least_weight;
    if (a >= 0) walk.diagonal[a] += weight;
    if (b >= 0) walk.diagonal[b] += weight;
    if (a >= 0 && b >= 0) walk.edges.push_back({a, b, weight});
    if (a >= 0 && b < 0 && seeds.values[w] == walker_inside) walk.right_side[a] += weight;
    if (b >= 0 && a < 0 && seeds.values[v] == walker_inside) walk.right_side[b] += weight;
  };
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        const std::size_t v = image.offset(i, j, k);
        if (i + 1 < image.size.x()) connect(v, image.offset(i + 1, j, k));
        if (j + 1 < image.size.y()) connect(v, image.offset(i, j + 1, k));
        if (k + 1 < image.size.z()) connect(v, image.offset(i, j, k + 1));
      }
  for (double& d : walk.diagonal) d += 1e-9;  // voxels that no seed reaches stay outside
  return walk;
}

void apply(const Walk& walk, const std::vector<double>& p, std::vector<double>& out) {
  for (std::size_t n = 0; n < p.size(); ++n) out[n] = walk.diagonal[n] * p[n];
  for (const Edge& e : walk.edges) {
    out[e.a] -= e.weight * p[e.b];
    out[e.b] -= e.weight * p[e.a];
  }
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += a[n] * b[n];
  return sum;
}

/// Conjugate gradients with the diagonal as preconditioner.
std::vector<double> probabilities(const Walk& walk) {
  const std::size_t n = walk.diagonal.size();
  std::vector<double> p(n, 0), r = walk.right_side, z(n), q(n), d(n);
  for (std::size_t i = 0; i < n; ++i) d[i] = z[i] = r[i] / walk.diagonal[i];
  double rz = dot(r, z);
  const double enough = rz * relative_residual * relative_residual;
  for (int it = 0; it < most_iterations && rz > enough; ++it) {
    apply(walk, d, q);
    const double alpha = rz / dot(d, q);
    for (std::size_t i = 0; i < n; ++i) {
      p[i] += alpha * d[i];
      r[i] -= alpha * q[i];
      z[i] = r[i] / walk.diagonal[i];
    }
    const double next = dot(r, z);
    for (std::size_t i = 0; i < n; ++i) d[i] = z[i] + next / rz * d[i];
    rz = next;
  }
  return p;
}

}  // namespace

Volume<std::uint8_t> random_walk(const Volume<float>& image, const Volume<std::uint8_t>& allowed,
                                 const Volume<std::uint8_t>& seeds, double range) {
  const Walk walk = build(image, allowed, seeds, range);
  const std::vector<double> p = probabilities(walk);
  auto inside = seeds.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < inside.values.size(); ++v) {
    const int n = walk.unknown_of[v];
    inside.values[v] = n >= 0 ? p[n] > 0.5 : seeds.values[v] == walker_inside && allowed.values[v];
  }
  return inside;
}

}  // namespace mammotwin
