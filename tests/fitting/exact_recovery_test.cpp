#include "fitting/fit_samples.h"
#include "fitting/newton_step.h"

#include "fitting/face_mesh.h"
#include "fitting/mesh/block_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace mammotwin {
namespace {

constexpr double side_mm = 100, depth_mm = 40;

/// Box in front of y = 0: ξ₁ along x, ξ₂ along z, ξ₃ towards −y.
std::vector<HermiteMesh::Node> lying_nodes(const Slab& slab) {
  const HermiteMesh box = block_mesh({0, 0, 0}, {side_mm, side_mm, depth_mm}, slab.elements);
  Eigen::Matrix3d turn;
  turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  std::vector<HermiteMesh::Node> nodes;
  for (const auto& node : box.nodes()) nodes.push_back(turn * node);
  return nodes;
}

/// Points of a skin given over (u, v) in [0,1]², on a grid of n x n, as data that is laid flat.
struct Data {
  TriangleSurface skin;
  FlatSkin flat;
};

Data data_on(const std::function<Eigen::Vector3d(double u, double v)>& skin, int n) {
  Data data;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      data.flat.uv.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n});
      data.skin.vertices.push_back(skin(data.flat.uv.back().x(), data.flat.uv.back().y()));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int v = i + (n + 1) * j;
      data.skin.triangles.push_back({v, v + 1, v + n + 2});
      data.skin.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  for (int k = 0; k <= n; ++k) {
    data.flat.edges[0].push_back(k * (n + 1));
    data.flat.edges[1].push_back(k * (n + 1) + n);
    data.flat.edges[2].push_back(k);
    data.flat.edges[3].push_back(n * (n + 1) + k);
  }
  return data;
}

/// Fits by the distance of data to mesh alone; shape and smoothing only decide what data leaves
/// open. Returns the root mean square that is left [mm].
double fit(const Slab& slab, const Data& data, std::vector<HermiteMesh::Node>& nodes) {
  constexpr double next_to_nothing = 1e-9;
  Volume<std::uint8_t> grid({2, 1, 2}, {side_mm, 1, side_mm}, {0, 0, 0});
  const HeightField wall(grid, std::vector<double>(4, 0.0));
  FitTarget target(slab, data.skin, data.flat, wall, {1e6, 0, 0});
  const HermiteMesh start(nodes, grid_corners(slab.elements));
  NewtonStep newton(start.elements(), held_parameters(slab));
  FitModel model(slab, start, next_to_nothing, 1e-15, std::vector<int>(start.num_elements(), 0));
  FitTarget::Weights weights;
  weights.mesh_to_data = 0;  // goes to flat triangles
  for (int step = 0; step < 12; ++step) {
    model.update(nodes, target.samples(HermiteMesh(nodes, start.elements()), weights));
    newton.step(model, false, nodes);
  }
  target.samples(HermiteMesh(nodes, start.elements()), weights);
  return target.skin_rms();
}

TEST(Fit, RecoversASkinThatIsAHermiteSurface) {
  const Slab slab{{3, 3, 1}};
  std::vector<HermiteMesh::Node> truth = lying_nodes(slab);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  // The skin's parameters 0 to 3 of its nodes move by up to 6 mm along y, its sides stay in planes.
  for (int j = 0; j <= 3; ++j)
    for (int i = 0; i <= 3; ++i)
      for (int d = 0; d < 4; ++d) truth[slab.node(i, j, 1)](1, d) += 6 * uniform(random);
  const HermiteMesh true_mesh(truth, grid_corners(slab.elements));
  const SkinPatches patches(slab, true_mesh);
  const Data data = data_on(
      [&](double u, double v) { return patches.at({3 * u, 3 * v}).x; }, 60);
  std::vector<HermiteMesh::Node> nodes = lying_nodes(slab);
  EXPECT_LT(fit(slab, data, nodes), 1e-6);
}

// Cubics follow a smooth surface to the fourth power of their size.
TEST(Fit, ConvergesWithTheFourthPowerOfTheElementSize) {
  const auto bell = [](double u, double v) {
    const double r2 = ((u - 0.45) * (u - 0.45) + (v - 0.52) * (v - 0.52)) * side_mm * side_mm;
    return Eigen::Vector3d(side_mm * u, -depth_mm - 30 * std::exp(-r2 / (2 * 22 * 22)), side_mm * v);
  };
  const Data data = data_on(bell, 64);
  std::vector<double> error;
  for (int n : {4, 8}) {
    const Slab slab{{n, n, 1}};
    std::vector<HermiteMesh::Node> nodes = lying_nodes(slab);
    error.push_back(fit(slab, data, nodes));
    RecordProperty("rms_" + std::to_string(n), std::to_string(error.back()));
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 3.5);
}

}  // namespace
}  // namespace mammotwin
