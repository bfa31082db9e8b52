#include "fitting/mesh/cylinder_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <map>
#include <numbers>
#include <stdexcept>

#include "fitting/mesh/jacobian_bound.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

constexpr double radius = 25, length = 100;

std::vector<CylinderElements> sizes() {
  return {
      {1, 1, 1, 0.5}, {2, 1, 3, 0.5}, {3, 2, 2, 0.45}, {4, 2, 1, 0.5}, {2, 3, 4, 0.5, 0.3, 0.2}};
}

/// Point (a, b) in [0,1]² of face 0 to 5, in the order of FaceLabels.
Vector3d on_face(int face, double a, double b) {
  const int axis = face / 2;
  Vector3d xi;
  xi[axis] = face % 2;
  xi[(axis + 1) % 3] = a;
  xi[(axis + 2) % 3] = b;
  return xi;
}

double volume(const HermiteMesh& mesh) {
  // Gauss-Legendre with 5 points is exact to degree 9; det has degree 8.
  constexpr std::array<double, 5> x = {0.04691007703066800, 0.23076534494715845, 0.5,
                                       0.76923465505284155, 0.95308992296933200};
  constexpr std::array<double, 5> w = {0.11846344252809454, 0.23931433524968324,
                                       0.28444444444444444, 0.23931433524968324,
                                       0.11846344252809454};
  double sum = 0;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int m = 0; m < 125; ++m)
      sum += w[m % 5] * w[m / 5 % 5] * w[m / 25] *
             mesh.jacobian({e, Vector3d(x[m % 5], x[m / 5 % 5], x[m / 25])}).determinant();
  return sum;
}

TEST(CylinderMesh, IsProvedValidWithoutCollapsedElements) {
  for (const auto& n : sizes()) {
    const HermiteMesh mesh = cylinder_mesh(radius, length, n).mesh;
    EXPECT_EQ(mesh.num_elements(), n.length * n.square * (n.square + 4 * n.ring));
    EXPECT_TRUE(proved_valid(mesh)) << n.square << " " << n.ring;
  }
}

TEST(CylinderMesh, MantleLiesOnTheCircle) {
  for (const auto& n : sizes()) {
    const MeshFile file = cylinder_mesh(radius, length, n);
    const double tolerance = radius * (n.square == 1 ? 3e-4 : 5e-6);
    int mantle_faces = 0;
    for (int e = 0; e < file.mesh.num_elements(); ++e)
      for (int face = 0; face < 6; ++face) {
        if (file.faces[e][face] != FaceLabel::skin) continue;
        ++mantle_faces;
        for (double a : {0.0, 0.3, 0.5, 0.8})
          for (double b : {0.0, 0.6})
            EXPECT_NEAR(file.mesh.position({e, on_face(face, a, b)}).head<2>().norm(), radius,
                        tolerance);
      }
    EXPECT_EQ(mantle_faces, 4 * n.square * n.length);
  }
}

TEST(CylinderMesh, HasTheVolumeOfACylinder) {
  const double exact = std::numbers::pi * radius * radius * length;
  EXPECT_NEAR(volume(cylinder_mesh(radius, length, {2, 1, 2, 0.5}).mesh) / exact, 1, 1e-5);
}

TEST(CylinderMesh, TiesHoldInItsOwnGeometryWhereTheyPromiseC1) {
  const MeshFile file = cylinder_mesh(radius, length, {2, 2, 2, 0.5});
  ASSERT_FALSE(file.ties.empty());
  for (const auto& t : file.ties) {
    const Vector3d tied = file.mesh.node(t.node).col(t.parameter);
    const Vector3d to = t.factor * file.mesh.node(t.to_node).col(t.to_parameter);
    EXPECT_LT((tied - to).norm(), 1e-12 * radius)
        << "node " << t.node << " parameter " << t.parameter;
  }
}

/// Moves every parameter by a random amount and then obeys the ties, in two rounds because a
/// tied parameter may itself be tied.
HermiteMesh disturbed(const MeshFile& file) {
  std::vector<HermiteMesh::Node> nodes = file.mesh.nodes();
  std::srand(3);
  for (auto& node : nodes) node += HermiteMesh::Node::Random();
  for (int round = 0; round < 2; ++round)
    for (const auto& t : file.ties)
      nodes[t.node].col(t.parameter) = t.factor * nodes[t.to_node].col(t.to_parameter);
  return HermiteMesh(nodes, file.mesh.elements());
}

TEST(CylinderMesh, TiesKeepADisturbedMeshClosed) {
  for (const auto& n : sizes()) {
    const MeshFile file = cylinder_mesh(radius, length, n);
    const HermiteMesh moved = disturbed(file);
    // Points of element faces that coincide before must coincide after.
    std::map<std::array<long, 3>, Vector3d> seen;
    for (int e = 0; e < moved.num_elements(); ++e)
      for (int face = 0; face < 6; ++face)
        for (double a : {0.25, 0.5, 0.75})
          for (double b : {0.25, 0.5, 0.75}) {
            const MeshPoint p{e, on_face(face, a, b)};
            const Vector3d before = 1e6 * file.mesh.position(p);
            const std::array<long, 3> key = {std::lround(before[0]), std::lround(before[1]),
                                             std::lround(before[2])};
            const auto [at, is_new] = seen.try_emplace(key, moved.position(p));
            EXPECT_LT((at->second - moved.position(p)).norm(), 1e-9);
          }
    const int faces = 6 * moved.num_elements();
    const int outer = n.length * 4 * n.square + 2 * n.square * (n.square + 4 * n.ring);
    EXPECT_EQ(static_cast<int>(seen.size()), 9 * (faces + outer) / 2);
  }
}

TEST(CylinderMesh, RefusesWhatIsNoCylinder) {
  EXPECT_THROW(cylinder_mesh(0, 1, {}), std::invalid_argument);
  EXPECT_THROW(cylinder_mesh(1, 1, {0, 1, 1, 0.5}), std::invalid_argument);
  EXPECT_THROW(cylinder_mesh(1, 1, {1, 1, 1, 0.8}), std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin
