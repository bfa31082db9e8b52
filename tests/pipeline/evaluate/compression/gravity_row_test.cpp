#include "pipeline/evaluate/compression/gravity_row.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "fitting/mesh/block_mesh.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

/// A block 80 mm deep in front of a wall in the plane y = 0, prone as it stands; supine its points
/// are where `supine` puts the nodes' positions (an affine map).
MeshFile block_in_two_poses(const Eigen::Affine3d& supine) {
  const HermiteMesh block = block_mesh({-50, -80, -50}, {50, 0, 50}, {2, 2, 2});
  MeshFile file{block, {}, {}, {}, {}, {}};
  for (int e = 0; e < block.num_elements(); ++e) {
    FaceLabels faces{};
    if (block.position({e, {0.5, 1, 0.5}}).y() == 0) faces[3] = FaceLabel::chest_wall;
    file.faces.push_back(faces);
  }
  auto& nodes = file.configurations["supine"] = block.nodes();
  for (HermiteMesh::Node& node : nodes) {
    node = (supine.linear() * node).eval();
    node.col(0) += supine.translation();
  }
  file.configurations["prone"] = block.nodes();
  return file;
}

Eigen::Affine3d moved_by(const Vector3d& way) { return Eigen::Affine3d(Eigen::Translation3d(way)); }

TEST(SupineMoves, CountLateralFromEitherSide) {
  const MeshFile file = block_in_two_poses(moved_by({30, 20, -10}));
  EXPECT_LT((supine_moves(file, Side::left, {0, -80, 0}).nipple - Vector3d(30, 20, -10)).norm(),
            1e-9);
  EXPECT_LT((supine_moves(file, Side::right, {0, -80, 0}).nipple - Vector3d(-30, 20, -10)).norm(),
            1e-9);
}

TEST(SupineMoves, PointsLieAsFarFromTheRibsAsWomensLandmarks) {
  const SupineMoves moves =
      supine_moves(block_in_two_poses(moved_by({12, 0, 9})), Side::left, {0, -80, 0});
  EXPECT_NEAR(moves.landmark_mm, 15, 1e-9);
  EXPECT_NEAR(moves.ribs_prone_mm, 18.7, 1);  // of the women's 54
  EXPECT_NEAR(moves.ribs_supine_mm, moves.ribs_prone_mm, 1e-9);
}

TEST(SupineMoves, PointsLieInTheUpperOuterPartOfEitherSide) {
  // Twice as wide: a point's way is its distance from the middle.
  Eigen::Affine3d wider = Eigen::Affine3d::Identity();
  wider.linear()(0, 0) = 2;
  const MeshFile file = block_in_two_poses(wider);
  const double left = supine_moves(file, Side::left, {30, -80, 0}).landmark_mm;
  EXPECT_NEAR(left, (21 + 50) / 2.0, 2) << "x from 21 to 50";
  EXPECT_NEAR(supine_moves(file, Side::right, {-30, -80, 0}).landmark_mm, left, 2);
  EXPECT_THROW(supine_moves(file, Side::left, {30, -80, 40}), std::runtime_error) << "none above";
}

TEST(SupineMoves, FlattenedTissueLiesNearerToTheRibs) {
  Eigen::Affine3d flat = Eigen::Affine3d::Identity();
  flat.linear()(1, 1) = 0.5;
  const SupineMoves moves = supine_moves(block_in_two_poses(flat), Side::left, {0, -80, 0});
  EXPECT_NEAR(moves.nipple.y(), 40, 1e-9);
  const double muscle = 2 * moves.ribs_supine_mm - moves.ribs_prone_mm;
  EXPECT_NEAR(muscle, 6, 1e-9);
  EXPECT_NEAR(moves.landmark_mm, (moves.ribs_prone_mm - muscle) / 2, 1e-9);
}

TEST(SupineMoves, WithoutAnEquilibriumOnTheBackSaysSo) {
  MeshFile file = block_in_two_poses(moved_by({1, 0, 0}));
  file.configurations.erase("supine");
  EXPECT_THROW(supine_moves(file, Side::left, {0, -80, 0}), std::runtime_error);
}

}  // namespace
}  // namespace mammotwin
