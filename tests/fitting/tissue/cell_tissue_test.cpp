#include "fitting/tissue/cell_tissue.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fitting/tissue/tissue_volumes.h"
#include "tests/fitting/distorted_mesh.h"

namespace mammotwin {
namespace {

constexpr double radius_mm = 6.5;  // a ball of 1.15 ml

/// Elements of 18 mm, as a breast's.
HermiteMesh breast_sized_mesh() {
  const HermiteMesh mesh = distorted_mesh({2, 2, 1}, 0.3);
  std::vector<HermiteMesh::Node> nodes;
  for (const auto& node : mesh.nodes()) nodes.push_back(1.8 * node);
  return HermiteMesh(nodes, mesh.elements());
}

Eigen::AlignedBox3d box_of(const HermiteMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& node : mesh.nodes()) box.extend(node.col(0).eval());
  return box;
}

/// Voxels of 1 mm over the mesh and 9 mm beyond: a ball of lesion in its middle, gland above.
Volume<Fractions> ball_and_half(const HermiteMesh& mesh) {
  const Eigen::AlignedBox3d box = box_of(mesh);
  const Eigen::Vector3i size = (box.sizes().array() + 20).ceil().matrix().cast<int>();
  Volume<Fractions> volume(size, Eigen::Vector3d::Ones(),
                           box.min() - Eigen::Vector3d::Constant(9.7));
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) {
        const Eigen::Vector3d x = volume.position(i, j, k);
        const bool lesion = (x - box.center()).norm() < radius_mm;
        volume(i, j, k) = lesion                     ? Fractions{0, 0, 1}
                          : x.x() > box.center().x() ? Fractions{0, 1, 0}
                                                     : Fractions{1, 0, 0};
      }
  return volume;
}

TissueVolumes at_points(const HermiteMesh& mesh, const CellTissue& tissue) {
  return tissue_in_mesh(mesh, [&](const Eigen::Vector3d& x, double) { return tissue.at(x); });
}

/// Voxels that lie in the mesh, one by one.
TissueVolumes in_voxels(const HermiteMesh& mesh, const Volume<Fractions>& voxels) {
  const InverseMap map(mesh);
  TissueVolumes sum;
  for (int k = 0; k < voxels.size.z(); ++k)
    for (int j = 0; j < voxels.size.y(); ++j)
      for (int i = 0; i < voxels.size.x(); ++i)
        if (map.locate(voxels.position(i, j, k))) {
          sum.fat += voxels(i, j, k).fat / 1000;
          sum.fibroglandular += voxels(i, j, k).fibroglandular / 1000;
          sum.lesion += voxels(i, j, k).lesion / 1000;
        }
  return sum;
}

/// Empty but for voxels in the mesh.
Volume<Fractions> emptied_outside(Volume<Fractions> voxels, const HermiteMesh& mesh) {
  const InverseMap map(mesh);
  for (int k = 0; k < voxels.size.z(); ++k)
    for (int j = 0; j < voxels.size.y(); ++j)
      for (int i = 0; i < voxels.size.x(); ++i)
        if (!map.locate(voxels.position(i, j, k))) voxels(i, j, k) = {};
  return voxels;
}

TEST(CellTissue, HoldsWhatTheVoxelsHold) {
  const HermiteMesh mesh = breast_sized_mesh();
  const Volume<Fractions> voxels = emptied_outside(ball_and_half(mesh), mesh);
  const TissueVolumes found = at_points(mesh, CellTissue(mesh, voxels));
  const TissueVolumes expected = in_voxels(mesh, voxels);
  ASSERT_GT(expected.lesion, 1);
  // What the project asks of breasts. Fat is the rest of the points' volume, which voxels of 1 mm
  // are 2 % off in a box of 36 x 36 x 18 mm.
  EXPECT_NEAR(found.lesion / expected.lesion, 1, 0.05);
  EXPECT_NEAR(found.fibroglandular / expected.fibroglandular, 1, 0.01);
  EXPECT_NEAR(found.fat / expected.fat, 1, 0.03);
}

TEST(CellTissue, CountsWhatLiesJustBehindTheMesh) {
  const HermiteMesh mesh = breast_sized_mesh();
  Volume<Fractions> voxels = emptied_outside(ball_and_half(mesh), mesh);
  for (auto& f : voxels.values)
    if (f.fibroglandular > 0) f = {1, 0, 0};
  // A lamella of gland, 2 mm thick, from 3 to 5 mm behind the middle of the mesh's far end in y,
  // and one as far beyond its end in x, which is a cut plane.
  const Eigen::AlignedBox3d box = box_of(mesh);
  double behind_ml = 0;
  for (int k = 0; k < voxels.size.z(); ++k)
    for (int j = 0; j < voxels.size.y(); ++j)
      for (int i = 0; i < voxels.size.x(); ++i) {
        const Eigen::Vector3d x = voxels.position(i, j, k), off = (x - box.center()).cwiseAbs();
        const double behind = x.y() - box.max().y(), beyond = x.x() - box.max().x();
        if (behind > 2.5 && behind < 4 && off.x() < 6 && off.z() < 6) {
          voxels(i, j, k) = {0, 1, 0};
          behind_ml += 1e-3;
        }
        if (beyond > 1 && beyond < 3 && off.y() < 6 && off.z() < 6) voxels(i, j, k) = {0, 1, 0};
      }
  const double found = at_points(mesh, CellTissue(mesh, voxels)).fibroglandular;
  EXPECT_NEAR(found / behind_ml, 1, 0.01);
}

TEST(CellTissue, SumsToOneInsideAndOutside) {
  const HermiteMesh mesh = breast_sized_mesh();
  const CellTissue tissue(mesh, ball_and_half(mesh));
  for (const auto& node : mesh.nodes())
    for (double out : {0.0, 0.4}) {
      const Fractions f = tissue.at((1 + out) * node.col(0));
      EXPECT_NEAR(f.fat + f.fibroglandular + f.lesion, 1, 1e-6);
    }
}

// Of shares that fill a cell, what is left for fat is rounding of either sign.
TEST(CellTissue, LeavesNoNegativeFat) {
  const HermiteMesh mesh = breast_sized_mesh();
  Volume<Fractions> voxels = ball_and_half(mesh);
  for (std::size_t v = 0; v < voxels.values.size(); ++v) {
    const float lesion = static_cast<float>(v % 97) / 9700;
    voxels.values[v] = {0, 1 - lesion, lesion};
  }
  const CellTissue tissue(mesh, voxels);
  const Eigen::AlignedBox3d box = box_of(mesh);
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d place((i % 16 + 0.5) / 16, (i / 16 % 16 + 0.5) / 16,
                                (i / 256 + 0.5) / 16);
    const Fractions f = tissue.at(box.min() + box.sizes().cwiseProduct(place));
    EXPECT_GE(f.fat, 0);
    EXPECT_FALSE(std::signbit(f.fat));
  }
}

}  // namespace
}  // namespace mammotwin
