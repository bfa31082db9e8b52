#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "solver/load/smooth_wall.h"
#include "solver/load/spring_bed.h"
#include "solver/load/wall_surface.h"
#include "tests/solver/test_meshes.h"

namespace mammotwin {
namespace {

constexpr double kRadius = 100;

/// A slab of 80 x 80 x 20 mm bent over a sphere of 100 mm.
HermiteMesh bent_slab() {
  return mapped_mesh({4, 4, 1}, [](const Eigen::Vector3d& xi) {
    const double a = 0.8 * (xi.x() - 0.5), b = 0.8 * (xi.y() - 0.5);
    return Eigen::Vector3d((kRadius + 20 * xi.z()) * Eigen::Vector3d(std::sin(a) * std::cos(b),
                                                                     std::sin(b),
                                                                     std::cos(a) * std::cos(b)));
  });
}

WallSurface wall_of(const HermiteMesh& mesh) {
  std::vector<std::pair<int, int>> faces;
  for (int e = 0; e < mesh.num_elements(); ++e) faces.push_back({e, 4});
  return WallSurface(mesh, faces);
}

TEST(WallSurface, DistanceToASphereIsTheRadius) {
  const HermiteMesh mesh = bent_slab();
  const WallSurface wall = wall_of(mesh);
  std::mt19937 random(5);
  const auto uniform = [&] { return 2 * (random() / 4294967295.0) - 1; };
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector3d direction =
        Eigen::Vector3d(0.3 * uniform(), 0.3 * uniform(), 1).normalized();
    const double gap = 5 * uniform();
    // Cubic interpolation over 20 mm of a sphere of 100 mm errs by h⁴/(384 R³) ~ 4e-4 mm.
    EXPECT_NEAR(wall.gap((kRadius + gap) * direction).gap, gap, 1e-3);
  }
}

TEST(WallSurface, NormalAndHessianAreDerivativesOfTheGap) {
  const HermiteMesh mesh = bent_slab();
  const WallSurface wall = wall_of(mesh);
  std::mt19937 random(6);
  const auto uniform = [&] { return 2 * (random() / 4294967295.0) - 1; };
  constexpr double h = 1e-4;
  int compared = 0;
  for (int trial = 0; trial < 60; ++trial) {  // 0.6 reaches beyond the rim
    const Eigen::Vector3d x = (kRadius + 3 * uniform()) *
                              Eigen::Vector3d(0.6 * uniform(), 0.6 * uniform(), 1).normalized();
    const Gap exact = wall.gap(x);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d dx = h * Eigen::Vector3d::Unit(k);
      const Gap plus = wall.gap(x + dx), minus = wall.gap(x - dx);
      if ((plus.hessian - minus.hessian).norm() > 1e-6) continue;  // across a patch's border
      ++compared;
      EXPECT_NEAR((plus.gap - minus.gap) / (2 * h), exact.normal[k], 1e-7);
      EXPECT_NEAR(((plus.normal - minus.normal) / (2 * h) - exact.hessian.col(k)).norm(), 0, 1e-6);
    }
  }
  EXPECT_GT(compared, 150);
}

/// A slab of 80 x 80 mm with waves, so that its sides go on in directions that differ from node to
/// node.
HermiteMesh wavy_slab() {
  return mapped_mesh({4, 4, 1}, [](const Eigen::Vector3d& xi) {
    const double x = 80 * (xi.x() - 0.5), y = 80 * (xi.y() - 0.5);
    return Eigen::Vector3d(x + 4 * std::sin(y / 11), y + 4 * std::sin(x / 13),
                           6 * std::sin(x / 12 + 0.4) * std::cos(y / 9) + 10 * xi.z());
  });
}

// Along circles that cross the lines which go on from the rim's nodes.
TEST(WallSurface, TheDistanceDoesNotLeapBeyondTheRim) {
  const WallSurface wall = wall_of(wavy_slab());
  constexpr int steps = 4000;
  for (const double height : {-4.0, 0.0, 4.0})
    for (const double reach : {50.0, 60.0, 80.0}) {
      const auto gap_at = [&](int n) {
        const double a = 2 * std::numbers::pi * n / steps;
        return wall.gap({reach * std::cos(a), reach * std::sin(a), height}).gap;
      };
      const double way = 2 * std::numbers::pi * reach / steps;
      for (int n = 0; n < steps; ++n)
        EXPECT_LE(std::abs(gap_at(n + 1) - gap_at(n)), 1.001 * way) << reach << ' ' << n;
    }
}

/// One patch of 40 x 40 mm whose nodal derivatives are drawn, so that the surface and the speed
/// over it vary as much as on the walls of fitted breasts.
HermiteMesh uneven_slab(unsigned seed) {
  HermiteMesh mesh = box_mesh({40, 40, 10}, {1, 1, 1});
  std::mt19937 random(seed);
  auto nodes = mesh.nodes();
  for (auto& node : nodes)
    for (const int parameter : {1, 2, 3})
      for (int axis = 0; axis < 3; ++axis)
        node(axis, parameter) += 40 * (2 * (random() / 4294967295.0) - 1);
  return HermiteMesh(nodes, mesh.elements());
}

std::vector<MeshPoint> wall_points() {
  std::vector<MeshPoint> points;
  for (int k = 0; k < 21 * 21; ++k) points.push_back({0, {k % 21 / 20.0, k / 21 / 20.0, 0}});
  return points;
}

/// Is the wall's scaled Jacobian below the 0.1 of fitted breasts?
bool folds(const HermiteMesh& mesh) {
  for (const MeshPoint& p : wall_points()) {
    const Eigen::Matrix3d j = mesh.jacobian(p);
    if (j.col(0).normalized().cross(j.col(1).normalized()).z() < 0.1) return true;
  }
  return false;
}

TEST(WallSurface, PointsOnUnevenPatchesAreFoundOnThem) {
  int patches = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    const HermiteMesh mesh = uneven_slab(seed);
    if (folds(mesh)) continue;
    ++patches;
    const WallSurface wall = wall_of(mesh);
    for (const MeshPoint& p : wall_points())
      if ((p.xi - Eigen::Vector3d(0.5, 0.5, 0)).cwiseAbs().maxCoeff() < 0.49) {
        EXPECT_NEAR(wall.gap(mesh.position(p)).gap, 0, 1e-9) << seed << ": " << p.xi;
      }
  }
  EXPECT_GT(patches, 400);
}

/// RMS distance of two walls' points of the same coordinates [mm].
double distance(const HermiteMesh& a, const HermiteMesh& b) {
  double squares = 0;
  int count = 0;
  for (int e = 0; e < a.num_elements(); ++e)
    for (int k = 0; k < 25; ++k, ++count) {
      const MeshPoint at{e, {k % 5 / 4.0, k / 5 / 4.0, 0}};
      squares += (a.position(at) - b.position(at)).squaredNorm();
    }
  return std::sqrt(squares / count);
}

TEST(SmoothWall, LosesHollowsAndKeepsTheChest) {
  const HermiteMesh even = bent_slab();
  std::vector<std::pair<int, int>> faces;
  for (int e = 0; e < even.num_elements(); ++e) faces.push_back({e, 4});
  auto nodes = even.nodes();
  std::mt19937 random(7);
  for (auto& node : nodes)
    node.col(0) += (2 * (random() / 4294967295.0) - 1) * node.col(0).normalized();
  const HermiteMesh uneven(nodes, even.elements());
  const auto smooth = [&](const HermiteMesh& mesh, double length) {
    return with_smooth_wall(mesh, {}, faces, length);
  };
  EXPECT_LT(distance(smooth(even, 5), even), 0.2);
  const double hollows = distance(uneven, even);
  EXPECT_GT(hollows, 0.3);
  EXPECT_LT(distance(smooth(uneven, 15), smooth(even, 15)), 0.6 * hollows);
  EXPECT_NEAR(distance(smooth(uneven, 1), smooth(even, 1)), hollows, 0.1 * hollows);
}

TEST(SmoothWall, LeavesAPlaneAsItIs) {
  const HermiteMesh plane = box_mesh({80, 80, 20}, {3, 3, 1});
  std::vector<std::pair<int, int>> faces;
  for (int e = 0; e < plane.num_elements(); ++e) faces.push_back({e, 4});
  const HermiteMesh smooth = with_smooth_wall(plane, {}, faces, 30);
  for (int node = 0; node < plane.num_nodes(); ++node)
    EXPECT_NEAR((smooth.node(node) - plane.node(node)).norm(), 0, 1e-9) << node;
}

TEST(SpringBed, PullsBackInProportion) {
  SurfaceResponse response;
  SurfacePoint point{};
  point.X = {1, 2, 3};
  Eigen::Matrix<double, 9, 1> y = Eigen::Matrix<double, 9, 1>::Zero();
  y.head<3>() = Eigen::Vector3d(1, 2, 5);
  ASSERT_TRUE(SpringBed(0.02).respond(y, point, 2, response));
  EXPECT_DOUBLE_EQ(response.energy, 0.04);
  EXPECT_DOUBLE_EQ(response.gradient[2], 0.04);
  EXPECT_DOUBLE_EQ(response.hessian(2, 2), 0.02);
  EXPECT_THROW(SpringBed(-1), std::invalid_argument);
}

TEST(SpringBed, StiffensBeyondItsReach) {
  SurfaceResponse response;
  SurfacePoint origin{};
  origin.X.setZero();
  Eigen::Matrix<double, 9, 1> y = Eigen::Matrix<double, 9, 1>::Zero();
  const SpringBed springs(0.02, 20);
  const auto pull = [&](double x) {
    y[0] = x;
    EXPECT_TRUE(springs.respond(y, origin, 2, response));
    return response.gradient[0];
  };
  EXPECT_NEAR(pull(2), 0.02 * 2, 0.001);  // exp(0.01)
  EXPECT_NEAR(pull(40) / pull(20), 2 * std::exp(3), 1e-9);
  pull(40);
  EXPECT_NEAR(response.energy, 0.02 / 2 * 400 * (std::exp(4) - 1), 1e-9);
  constexpr double h = 1e-4;
  const double tangent = (pull(20 + h) - pull(20 - h)) / (2 * h);
  pull(20);
  EXPECT_NEAR(response.hessian(0, 0), tangent, 1e-7);
  EXPECT_THROW(SpringBed(0.02, 0), std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin
