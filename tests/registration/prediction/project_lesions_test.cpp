#include "registration/prediction/project_lesions.h"

#include <gtest/gtest.h>

#include "tests/registration/squeezed_box.h"

namespace mammotwin {
namespace {

TEST(AffineBaseline, IsExactWhereTheTissueMovesAffinely) {
  // The squeezed box moves by the baseline's own law, held at the edge and at its own centroid.
  const SqueezedBox breast = squeezed_box(Side::left, 0, 0.5);
  const AffineBaseline baseline(breast.prone, breast.view);
  const Eigen::Vector3d prone(50, -37, 12);
  const Eigen::Vector3d expected = breast.view.frame.view_from_lps(breast.A * prone + breast.b);
  EXPECT_LT((baseline.view_from_prone(prone) - expected).norm(), 1e-9);
  EXPECT_NEAR(baseline.prone_extent_mm(), 80, 1e-9);
  EXPECT_NEAR(baseline.stretch(), std::sqrt(2.0), 1e-12);
}

TEST(AffineBaseline, KeepsVolumeInAnObliqueView) {
  const SqueezedBox breast = squeezed_box(Side::right, 45, 0.4);
  const AffineBaseline baseline(breast.prone, breast.view);
  const Eigen::Vector3d o(-70, -30, 0);
  Eigen::Matrix3d map;
  for (int i = 0; i < 3; ++i)
    map.col(i) =
        baseline.view_from_prone(o + Eigen::Vector3d::Unit(i)) - baseline.view_from_prone(o);
  EXPECT_NEAR(std::abs(map.determinant()), 1, 1e-9);
}

TEST(AffineBaseline, RefusesABreastBehindTheEdge) {
  SqueezedBox breast = squeezed_box(Side::left, 0, 0.5);
  breast.view.frame.origin_in_lps.y() = -200;
  EXPECT_THROW(AffineBaseline(breast.prone, breast.view), std::invalid_argument);
}

TEST(PointCarrier, TakesAPointOutsideAlongWithItsNearestTissue) {
  const SqueezedBox breast = squeezed_box(Side::left, 0, 0.5);
  const PointCarrier carrier(breast.prone, breast.compressed);
  const Eigen::Vector3d nipple(70, -63, 0);  // 3 mm in front of the box
  const CarriedPoint carried = carrier.carry(nipple);
  EXPECT_NEAR(carried.outside_mm, 3, 1e-9);
  EXPECT_LT((carried.in_lps - (breast.A * nipple + breast.b)).norm(), 1e-9);
  EXPECT_FALSE(carrier.carry_inside(nipple).has_value());
}

TEST(PointCarrier, RefusesConfigurationsOfDifferentMeshes) {
  const SqueezedBox breast = squeezed_box(Side::left, 0, 0.5);
  EXPECT_THROW(PointCarrier(breast.prone, block_mesh({0, 0, 0}, {1, 1, 1}, {4, 3, 1})),
               std::invalid_argument);
}

TEST(ViewProjection, LeavesPixelsEmptyWithoutASpacing) {
  const SqueezedBox breast = squeezed_box(Side::left, 0, 0.5);
  const ViewProjection projection(breast.prone, breast.compressed, breast.view, Detector{});
  EXPECT_FALSE(projection.project({"1", {50, -20, 3}}).in_image.has_value());
}

}  // namespace
}  // namespace mammotwin
