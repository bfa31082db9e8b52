#include "pipeline/validation/box_fit.h"

#include <Eigen/Geometry>
#include <cmath>

#include "fitting/mesh/block_mesh.h"
#include "fitting/solve/fit_samples.h"
#include "fitting/solve/newton_step.h"

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

/// BoxFit::hold for each sample, in both directions along its plane.
void hold_along_planes(const HermiteMesh& mesh, double share, std::vector<PlaneSample>& samples) {
  const std::size_t count = samples.size();
  for (std::size_t i = 0; i < count; ++i) {
    const PlaneSample s = samples[i];
    const Eigen::Vector3d first = s.normal.unitOrthogonal();
    for (const Eigen::Vector3d& along : {first, Eigen::Vector3d(s.normal.cross(first))})
      samples.push_back({s.point, along, mesh.position(s.point), share * s.weight});
  }
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
  NewtonStep newton(start.elements(), held_parameters(slab));
  FitModel model(slab, start, kNextToNothing, kNoSmoothing,
                 std::vector<int>(start.num_elements(), 0));
  FitTarget::Weights weights;
  weights.mesh_to_data = 0;  // goes to flat triangles
  for (int step = 0; step < options.steps; ++step) {
    const HermiteMesh mesh(nodes, start.elements());
    std::vector<PlaneSample> samples = target.samples(mesh, weights);
    if (options.hold > 0) hold_along_planes(mesh, options.hold, samples);
    model.update(nodes, samples);
    newton.step(model, nodes);
  }
  target.samples(HermiteMesh(nodes, start.elements()), weights);
  return target.skin_rms();
}

}  // namespace mammotwin
