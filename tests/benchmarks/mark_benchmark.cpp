#include <benchmark/benchmark.h>

#include <cmath>

#include "fitting/mesh/block_mesh.h"
#include "registration/search/mark_curve.h"
#include "registration/view/view_frame.h"

namespace mammotwin {
namespace {

/// A breast's mesh of the usual size, bent so that no inverse map is trivial: a block of 7 x 7 x 2
/// elements, 100 x 60 x 80 mm.
HermiteMesh prone_breast() {
  HermiteMesh block = block_mesh({20, -60, -40}, {120, 0, 40}, {7, 2, 7});
  std::vector<HermiteMesh::Node> nodes = block.nodes();
  for (HermiteMesh::Node& node : nodes) {
    const double angle = 0.01 * node(0, 0);  // [rad]
    Eigen::Matrix3d bend = Eigen::Matrix3d::Identity();
    bend.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle),
        std::cos(angle);
    node = (bend * node).eval();
  }
  return HermiteMesh(nodes, block.elements());
}

/// Squeezed to half along the beam, its volume kept, with every state's number varied.
struct View {
  ViewRays rays;
  ViewUncertainty uncertainty;
};

View squeezed(const HermiteMesh& prone, double angle_deg) {
  CompressedView view{"view", Side::left, angle_deg, 40, {}};
  view.frame.axes = view_axes(Side::left, angle_deg);
  const Eigen::Vector3d stretch(std::sqrt(2), std::sqrt(2), 0.5);
  std::vector<HermiteMesh::Node> nodes = prone.nodes();
  for (HermiteMesh::Node& node : nodes)
    node = (view.frame.axes.transpose() * stretch.asDiagonal() * view.frame.axes * node).eval();
  view.frame.origin_in_lps = nodes.front().col(0);
  ViewUncertainty uncertainty;
  for (int i = 0; i < kMechanical; ++i) {
    uncertainty.varied[i] = nodes;
    for (HermiteMesh::Node& node : uncertainty.varied[i]) node *= 1 + 0.01 * (i + 1);
  }
  return {ViewRays(prone, HermiteMesh(nodes, prone.elements()), view, Detector()), uncertainty};
}

/// What `mammotwin-mark` computes for a mark on each view: both curves with the ellipse at each
/// point, and the point of closest approach.
void TwoMarks(benchmark::State& state) {
  const HermiteMesh prone = prone_breast();
  const View cc = squeezed(prone, 0), mlo = squeezed(prone, 45);
  const MeshPoint lesion{20, {0.4, 0.5, 0.6}};
  const Eigen::Vector2d on_cc = cc.rays.project(lesion), on_mlo = mlo.rays.project(lesion);
  std::size_t points = 0;
  for (auto _ : state) {
    const auto a = mark_curve(cc.rays, on_cc, mlo.rays, &mlo.uncertainty);
    const auto b = mark_curve(mlo.rays, on_mlo, cc.rays, &cc.uncertainty);
    benchmark::DoNotOptimize(
        closest_approach(cc.rays, on_cc, a.on_ray, mlo.rays, on_mlo, b.on_ray));
    points = a.on_ray.size() + b.on_ray.size();
  }
  state.counters["points"] = static_cast<double>(points);
}
BENCHMARK(TwoMarks)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mammotwin
