#include "fitting/tissue/tissue_volumes.h"

#include <gtest/gtest.h>

#include "tests/fitting/distorted_mesh.h"
#include "tests/fitting/dome.h"

namespace mammotwin {
namespace {

TEST(TissueVolumes, AHalfAndHalfBoxHoldsHalfOfEach) {
  const HermiteMesh box =
      block_mesh(Eigen::Vector3d::Zero(), Eigen::Vector3d(40, 20, 10), {2, 2, 1});
  const TissueVolumes v = tissue_in_mesh(box, [](const Eigen::Vector3d&, double) {
    return Fractions{0.5f, 0.25f, 0.25f};
  });
  EXPECT_NEAR(v.fat, 4, 1e-12);
  EXPECT_NEAR(v.fibroglandular, 2, 1e-12);
  EXPECT_NEAR(v.lesion, 2, 1e-12);
}

TEST(TissueVolumes, CellsOfADistortedMeshFillIt) {
  // A linear fraction in x over a box whose inner nodes are moved: the outside stays, and so do
  // both integrals. 4 points integrate degree 7 of 11 along each ξ; distortion is mild.
  const HermiteMesh box =
      block_mesh(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(20), {2, 2, 2});
  std::vector<HermiteMesh::Node> nodes = box.nodes();
  nodes[13].col(0) += Eigen::Vector3d(1.5, -1, 0.5);
  nodes[13].col(3) += Eigen::Vector3d(0.5, 1, -2);
  const HermiteMesh mesh(nodes, box.elements());
  const TissueVolumes v = tissue_in_mesh(mesh, [](const Eigen::Vector3d& x, double) {
    const float part = static_cast<float>(x.x() / 20);
    return Fractions{1 - part, part, 0};
  });
  EXPECT_NEAR(v.fibroglandular, 4, 1e-4);
  EXPECT_NEAR(v.total(), 8, 1e-6);
}

TEST(TissueVolumes, VoxelsCountInTheRegionInFrontOfTheMuscle) {
  Segmentation s = dome_breast();
  for (auto& f : s.fractions.values) f = {0.75f, 0.25f, 0};
  long voxels = 0;
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i)
        voxels += s.labels(i, j, k) == label::fat && s.region.contains(s.labels.position(i, j, k));
  EXPECT_NEAR(tissue_in_voxels(s).fat, 0.75 * voxels * 8 / 1000, 1e-6);
}

}  // namespace
}  // namespace mammotwin
