#include "segmentation/lesion/random_walker.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <cmath>
#include <vector>

namespace mammotwin {
namespace {

constexpr double beta = 100, least_weight = 1e-5;
constexpr int most_iterations = 400;
constexpr double relative_residual = 1e-5;

using Matrix = Eigen::SparseMatrix<double>;

/// The graph of free voxels: Laplacian L p = f, f from the inside seeds.
struct Walk {
  std::vector<int> unknown_of;  ///< of each voxel; -1 where it is none
  Matrix laplacian;
  Eigen::VectorXd right_side;
};

Walk build(const Volume<float>& image, const Volume<std::uint8_t>& allowed,
           const Volume<std::uint8_t>& seeds, double range) {
  Walk walk;
  int count = 0;
  for (std::size_t v = 0; v < seeds.values.size(); ++v)
    walk.unknown_of.push_back(allowed.values[v] && seeds.values[v] == walker_free ? count++ : -1);
  walk.right_side.setZero(count);
  // Voxels that no seed reaches stay outside.
  Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(count, 1e-9);
  std::vector<Eigen::Triplet<double>> entries;
  const auto connect = [&](std::size_t v, std::size_t w) {
    if (!allowed.values[v] || !allowed.values[w]) return;
    const int a = walk.unknown_of[v], b = walk.unknown_of[w];
    if (a < 0 && b < 0) return;
    const double d = (image.values[v] - image.values[w]) / range;
    const double weight = std::exp(-beta * d * d) + least_weight;
    if (a >= 0) diagonal[a] += weight;
    if (b >= 0) diagonal[b] += weight;
    if (a >= 0 && b >= 0) entries.emplace_back(a, b, -weight), entries.emplace_back(b, a, -weight);
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
  for (int n = 0; n < count; ++n) entries.emplace_back(n, n, diagonal[n]);
  walk.laplacian.resize(count, count);
  walk.laplacian.setFromTriplets(entries.begin(), entries.end());
  return walk;
}

/// Conjugate gradients with the diagonal as preconditioner.
Eigen::VectorXd probabilities(const Walk& walk) {
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver(walk.laplacian);
  solver.setTolerance(relative_residual);
  solver.setMaxIterations(most_iterations);
  return solver.solve(walk.right_side);
}

}  // namespace

Volume<std::uint8_t> random_walk(const Volume<float>& image, const Volume<std::uint8_t>& allowed,
                                 const Volume<std::uint8_t>& seeds, double range) {
  const Walk walk = build(image, allowed, seeds, range);
  const Eigen::VectorXd p = probabilities(walk);
  auto inside = seeds.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < inside.values.size(); ++v) {
    const int n = walk.unknown_of[v];
    inside.values[v] = n >= 0 ? p[n] > 0.5 : seeds.values[v] == walker_inside && allowed.values[v];
  }
  return inside;
}

}  // namespace mammotwin
