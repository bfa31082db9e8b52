#include "registration/carry/position_grid.h"

#include <gtest/gtest.h>

#include "tests/registration/squeezed_box.h"

namespace mammotwin {
namespace {

TEST(PositionGrid, HoldsTheOtherConfigurationInsideAndNothingOutside) {
  const SqueezedBox breast = squeezed_box(Side::left, 45, 0.5);
  Eigen::AlignedBox3d box = bounding_box(breast.compressed);
  box.min() -= Eigen::Vector3d::Constant(6);
  PositionGrid grid = cover(box, 5);
  fill_positions(breast.compressed, breast.prone, grid);
  const Eigen::Matrix3d back = breast.A.inverse();
  int inside = 0;
  for (int k = 0; k < grid.size.z(); ++k)
    for (int j = 0; j < grid.size.y(); ++j)
      for (int i = 0; i < grid.size.x(); ++i) {
        const Eigen::Vector3d prone = back * (grid.position(i, j, k) - breast.b);
        const bool in_box =
            Eigen::AlignedBox3d(Eigen::Vector3d(20, -60, -40), Eigen::Vector3d(120, 0, 40))
                .contains(prone);
        ASSERT_EQ(grid(i, j, k).allFinite(), in_box) << i << ' ' << j << ' ' << k;
        if (!in_box) continue;
        ++inside;
        ASSERT_LT((grid(i, j, k) - prone).norm(), 1e-8);  // the inverse map answers to 1e-9 mm
      }
  const double box_volume = 100 * 60 * 80;  // unchanged by the squeeze
  EXPECT_NEAR(inside * grid.voxel_volume(), box_volume, 0.05 * box_volume);  // 5 mm staircase
}

TEST(PositionGrid, ViewFrameMeshHoldsViewCoordinates) {
  const SqueezedBox breast = squeezed_box(Side::right, 45, 0.5);
  const HermiteMesh mesh = in_view_frame(breast.compressed, breast.view.frame);
  const MeshPoint p{7, {0.3, 0.6, 0.9}};
  EXPECT_LT(
      (mesh.position(p) - breast.view.frame.view_from_lps(breast.compressed.position(p))).norm(),
      1e-12);
}

}  // namespace
}  // namespace mammotwin
