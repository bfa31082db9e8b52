#include "pipeline/validation/box_fit.h"

#include <Eigen/Geometry>
#include <cmath>

#include "fitting/mesh/block_mesh.h"
#include "fitting/solve/fit_problem.h"
#include "fitting/solve/fit_samples.h"

namespace mammotwin {
namespace {

constexpr double kNextToNothing = 1e-9, kNoSmoothing = 1e-15;

/// A skin's points, laid flat.
struct Points {
  TriangleSurface skin;
  FlatSkin flat;
};

Points points_on(const Skin& skin, int per_side) {
  Points points;
  const int n = per_side - 1;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const Eigen::Vector2d uv(static_cast<double>(i) / n, static_cast<double>(j) / n);
      points.flat.uv.push_back(uv);
      points.skin.vertices.push_back(skin(uv.x(), uv.y()));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int v = i + per_side * j;
      points.skin.triangles.push_back({v, v + 1, v + per_side + 1});
      points.skin.triangles.push_back({v, v + per_side + 1, v + per_side});
    }
  for (int k = 0; k <= n; ++k) {
    points.flat.edges[0].push_back(k * per_side);
    points.flat.edges[1].push_back(k * per_side + n);
    points.flat.edges[2].push_back(k);
    points.flat.edges[3].push_back(n * per_side + k);
  }
  return points;
}

}  // namespace

std::vector<HermiteMesh::Node> box_nodes(const Slab& slab) {
  const HermiteMesh box =
      block_mesh({0, 0, 0}, {kBoxSide_mm, kBoxSide_mm, kBoxDepth_mm}, slab.elements);
  Eigen::Matrix3d turn;
  turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  std::vector<HermiteMesh::Node> nodes;
  for (const auto& node : box.nodes()) nodes.push_back(turn * node);
  return nodes;
}

Eigen::Vector3d bell_on_box(double u, double v) {
  constexpr double height_mm = 30, width_mm = 22;
  const double squared =
      (std::pow(u - 0.45, 2) + std::pow(v - 0.52, 2)) * kBoxSide_mm * kBoxSide_mm;
  return {kBoxSide_mm * u,
          -kBoxDepth_mm - height_mm * std::exp(-squared / (2 * width_mm * width_mm)),
          kBoxSide_mm * v};
}

double fit_box(const Slab& slab, const Skin& skin, const BoxFit& options,
               std::vector<HermiteMesh::Node>& nodes) {
  const Points points = points_on(skin, options.points_per_side);
  const Volume<std::uint8_t> grid({2, 1, 2}, {kBoxSide_mm, 1, kBoxSide_mm}, {0, 0, 0});
  const HeightField wall(grid, std::vector<double>(4, 0.0));
  const Eigen::Vector3d no_nipple(1e6, 0, 0);
  FitTarget target(slab, points.skin, points.flat, wall, no_nipple);
  const HermiteMesh start(nodes, grid_corners(slab.elements));
  FitTarget::Weights weights;
  weights.mesh_to_data = 0;  // goes to flat triangles
  target.weigh_mesh(start);
  FitPoint point(slab, start, target);
  point.model().weigh(kNextToNothing, kNoSmoothing);
  point.set_weights(weights);
  FitProblem problem(point, start.elements(), held_parameters(slab), nodes);
  ceres::Solver::Options solver = FitProblem::options();
  solver.max_num_iterations = options.steps;
  if (options.hold > 0) {
    solver.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
    solver.initial_trust_region_radius = solver.max_trust_region_radius = 1 / options.hold;
  }
  problem.solve(solver);
  target.samples(HermiteMesh(nodes, start.elements()), weights);
  return target.skin_rms();
}

}  // namespace mammotwin
