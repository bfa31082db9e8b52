#include "fitting/mesh/inverse_map.h"

#include <gtest/gtest.h>

#include "tests/fitting/distorted_mesh.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

constexpr double tolerance = 1e-8;  // InverseMap promises 1e-9 mm; the rest is rounding

MeshPoint random_point(const HermiteMesh& mesh, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const int element = static_cast<int>(random() % mesh.num_elements());
  return {element, Vector3d(uniform(random), uniform(random), uniform(random))};
}

TEST(InverseMap, FindsThePointsOfADistortedMesh) {
  const HermiteMesh mesh = distorted_mesh({3, 2, 2}, 2);
  const InverseMap map(mesh);
  std::mt19937 random(5);
  for (int i = 0; i < 2000; ++i) {
    const MeshPoint p = random_point(mesh, random);
    const auto found = map.locate(mesh.position(p));
    ASSERT_TRUE(found) << "element " << p.element << " xi " << p.xi.transpose();
    EXPECT_EQ(found->element, p.element);
    EXPECT_LT((found->xi - p.xi).norm(), tolerance);
  }
}

TEST(InverseMap, AWrongGuessChangesNothing) {
  const HermiteMesh mesh = distorted_mesh({3, 2, 2}, 2);
  const InverseMap map(mesh);
  const MeshPoint p{7, Vector3d(0.2, 0.9, 0.4)};
  const auto found = map.locate(mesh.position(p), {0, Vector3d::Constant(0.5)});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->element, p.element);
}

TEST(InverseMap, KnowsWhatIsOutside) {
  const HermiteMesh mesh = distorted_mesh({2, 2, 2}, 1);
  const InverseMap map(mesh);
  EXPECT_FALSE(map.locate(Vector3d(-20, 0, 0)));
  EXPECT_FALSE(map.locate(mesh.position({0, Vector3d(0, 0.5, 0.5)}) - Vector3d(1e-3, 0, 0)));
}

TEST(InverseMap, HoldsItsCornersAndFaces) {
  const HermiteMesh mesh = distorted_mesh({2, 2, 2}, 2);
  const InverseMap map(mesh);
  for (int n = 0; n < mesh.num_nodes(); ++n) EXPECT_TRUE(map.locate(mesh.node(n).col(0)));
}

TEST(InverseMap, NearestPointOfABoxIsItsClampedPosition) {
  const Vector3d low(0, 0, 0), high(20, 10, 30);
  const HermiteMesh box = block_mesh(low, high, {2, 1, 3});
  const InverseMap map(box);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-20, 50);
  for (int i = 0; i < 500; ++i) {
    const Vector3d x(uniform(random), uniform(random), uniform(random));
    const Vector3d expected = x.cwiseMax(low).cwiseMin(high);
    EXPECT_LT((box.position(map.nearest(x)) - expected).norm(), 1e-6) << x.transpose();
  }
}

TEST(InverseMap, NearestIsNoFartherThanAnySample) {
  const HermiteMesh mesh = distorted_mesh({2, 2, 2}, 2);
  const InverseMap map(mesh);
  std::mt19937 random(11);
  for (const Vector3d& x : {Vector3d(-9, 3, 4), Vector3d(30, 30, 30), Vector3d(6, 12, -8)}) {
    const double distance = (mesh.position(map.nearest(x)) - x).norm();
    for (int i = 0; i < 20000; ++i)
      EXPECT_LE(distance, (mesh.position(random_point(mesh, random)) - x).norm() + tolerance);
  }
}

}  // namespace
}  // namespace mammotwin
