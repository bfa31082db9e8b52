#include "fitting/solve/fit_samples.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fitting/flat_target.h"

namespace mammotwin {
namespace {

constexpr double kSkinSide = FlatTarget::side, kSkinDepth = FlatTarget::depth;
constexpr int kData = 81, kOnEdges = 4 * 9;  // of FlatTarget's sheet

double sum_of_weights(const std::vector<PlaneSample>& samples, int first, int count) {
  double sum = 0;
  for (int n = first; n < first + count; ++n) sum += samples[n].weight;
  return sum;
}

// An edge's corners are half a segment of eight each and count as a twentieth of their edge
// instead.
TEST(FitSamples, EachKindHasTheWeightThatItIsGivenWhateverTheMesh) {
  FitTarget::Weights weights;
  weights.all = 3;
  for (const Eigen::Vector3i& elements : {Eigen::Vector3i(1, 1, 1), Eigen::Vector3i(3, 2, 2)}) {
    FlatTarget flat(elements, 2);
    const std::vector<PlaneSample> samples = flat.target.samples(flat.box, weights);
    const int faces = elements.x() * elements.y(), on_mesh = 64 * faces, on_wall = 49 * faces;
    ASSERT_EQ(static_cast<int>(samples.size()), kData + kOnEdges + on_mesh + on_wall);
    int first = 0;
    EXPECT_NEAR(sum_of_weights(samples, first, kData), 3 * weights.data_to_mesh, 1e-12);
    first += kData;
    EXPECT_NEAR(sum_of_weights(samples, first, kOnEdges),
                3 * weights.edges * (1 - 2.0 / 16 + 2 * 0.05), 1e-12);
    first += kOnEdges;
    EXPECT_NEAR(sum_of_weights(samples, first, on_mesh), 3 * weights.mesh_to_data, 1e-12);
    first += on_mesh;
    EXPECT_NEAR(sum_of_weights(samples, first, on_wall), 3 * weights.wall, 1e-12);
  }
}

TEST(FitSamples, DataAreSeenAtTheirFeetAcrossTheSkin) {
  FlatTarget flat({3, 2, 1}, 2);
  const std::vector<PlaneSample> samples = flat.target.samples(flat.box, {});
  for (int n = 0; n < kData; ++n) {
    const Eigen::Vector3d foot = flat.box.position(samples[n].point);
    EXPECT_LT((samples[n].target - flat.skin.vertices[n]).norm(), 1e-12);
    EXPECT_LT((foot - (flat.skin.vertices[n] + 2 * Eigen::Vector3d::UnitY())).norm(), 1e-6);
    EXPECT_NEAR(std::abs(samples[n].normal.y()), 1, 1e-12);
  }
  EXPECT_NEAR(flat.target.skin_rms(), 2, 1e-9);
}

// A triangle's normal would leave out how far beside the skin's border the mesh lies.
TEST(FitSamples, BesideTheBorderTheMeshIsDrawnToItsNearestPlace) {
  FlatTarget flat({2, 2, 1}, 2);
  std::vector<HermiteMesh::Node> nodes = flat.box.nodes();
  for (auto& node : nodes) node(0, 0) += 10;
  const HermiteMesh beside(nodes, flat.box.elements());
  const auto samples = flat.target.samples(beside, {});
  int seen = 0;
  for (int n = kData + kOnEdges; n < kData + kOnEdges + 4 * 64; ++n) {
    const Eigen::Vector3d off = beside.position(samples[n].point) - samples[n].target;
    const double beyond = beside.position(samples[n].point).x() - kSkinSide;
    if (beyond <= 0) continue;
    ++seen;
    EXPECT_NEAR(std::abs(samples[n].normal.dot(off)), std::hypot(beyond, 2), 1e-6);
  }
  EXPECT_GT(seen, 10);
}

// A nipple's weight is 20 and falls as a Gaussian 10 mm wide: 1 + 20 exp(-d² / 200).
TEST(FitSamples, SkinCountsMoreNearTheNipple) {
  FlatTarget flat({2, 2, 1}, 0);
  const Eigen::Vector3d nipple(kSkinSide / 2, -kSkinDepth, kSkinSide / 2);
  FitTarget target(flat.slab, flat.skin, flat.flat, flat.wall, nipple);
  target.weigh_mesh(flat.box);
  const auto with = target.samples(flat.box, {});
  const auto without = flat.target.samples(flat.box, {});
  const int edges_from = kData, mesh_from = kData + kOnEdges;
  for (int n = 0; n < mesh_from + 4 * 64; ++n) {
    const double d2 = (with[n].target - nipple).squaredNorm();
    const bool on_edge = n >= edges_from && n < mesh_from;
    EXPECT_NEAR(with[n].weight / without[n].weight, on_edge ? 1 : 1 + 20 * std::exp(-d2 / 200),
                1e-9);
  }
}

// A wall 10 mm off: Cauchy's loss of that scale is 100 log 2 mm², and its slope half a square's.
TEST(FitSamples, AWallFarOffCountsByCauchysLoss) {
  FlatTarget flat({2, 2, 1}, 0);
  std::vector<HermiteMesh::Node> nodes = flat.box.nodes();
  for (auto& node : nodes) node(1, 0) -= 10;
  const HermiteMesh away(nodes, flat.box.elements());
  const FitTarget::Weights weights;
  const auto samples = flat.target.samples(away, weights);
  double loss = 0, squares = 0;
  for (std::size_t n = kData + kOnEdges + 4 * 64; n < samples.size(); ++n) {
    const PlaneSample& s = samples[n];
    const double r = s.normal.dot(away.position(s.point) - s.target);
    EXPECT_NEAR(std::abs(r), 10, 1e-12);
    squares += s.weight * r * r;
    loss += s.weight * r * r + s.beyond_square;
  }
  EXPECT_NEAR(squares, weights.wall * 100 / 2, 1e-9);
  EXPECT_NEAR(loss, weights.wall * 100 * std::log(2), 1e-9);
}

}  // namespace
}  // namespace mammotwin
