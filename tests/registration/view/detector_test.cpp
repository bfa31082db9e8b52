#include "registration/view/detector.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mammotwin {
namespace {

TEST(Detector, ShiftsAPointAsTheConeBeamDoes) {
  // reference: source 650 mm, 30 mm above the detector, 80 mm from the central ray.
  Detector detector;
  detector.source_distance_mm = 650;
  const Eigen::Vector2d at = detector.project({80, 0, 30});
  EXPECT_NEAR(at.x() - 80, 80 * 30.0 / 620, 1e-12);  // 3.87 mm
}

TEST(Detector, LeavesPointsOnTheSupportAloneWhereItIsTheDetector) {
  const Detector detector;
  EXPECT_EQ(detector.project({50, -20, 0}), Eigen::Vector2d(50, -20));
}

TEST(Detector, MagnifiesByTheGapBelowTheSupport) {
  Detector detector;
  detector.support_gap_mm = 20;
  EXPECT_NEAR(detector.project({50, -20, 0}).x(), 50 * 660.0 / 640, 1e-12);
}

TEST(Detector, RayPassesThroughSourcePointAndDetector) {
  Detector detector;
  detector.support_gap_mm = 12;
  const Eigen::Vector3d x(73, -41, 38);
  const Eigen::Vector2d uv = detector.project(x);
  EXPECT_LT((detector.point_on_ray(uv, x.z()) - x).norm(), 1e-12);
  EXPECT_LT((detector.point_on_ray(uv, -12).head<2>() - uv).norm(), 1e-12);
  EXPECT_LT(
      (detector.point_on_ray(uv, detector.source_in_view().z()) - detector.source_in_view()).norm(),
      1e-12);
}

TEST(Detector, PutsTheChestWallOnTheEdgeThatIsNamed) {
  Detector detector;
  detector.pixels = PixelGrid{0.1, 1914, 2294, ImageEdge::left};
  const Eigen::Vector2d edge_middle(0, 0);
  EXPECT_EQ(detector.image_from_detector(edge_middle), Eigen::Vector2d(-0.5, 1146.5));
  detector.pixels->chest_wall = ImageEdge::right;
  EXPECT_EQ(detector.image_from_detector(edge_middle), Eigen::Vector2d(1913.5, 1146.5));
  // 20 mm lateral of the middle is 200 rows higher in the image, or lower if it is hung so.
  EXPECT_NEAR(detector.image_from_detector({0, 20}).y(), 1146.5 - 200, 1e-9);
  detector.pixels->lateral_at_top = false;
  EXPECT_NEAR(detector.image_from_detector({0, 20}).y(), 1146.5 + 200, 1e-9);
}

TEST(Detector, RefusesWhatCannotBe) {
  Detector detector;
  EXPECT_THROW(detector.project({0, 0, 660}), std::invalid_argument);
  EXPECT_THROW(detector.image_from_detector({0, 0}), std::logic_error);
  detector.source_distance_mm = 66;  // cm for mm
  EXPECT_THROW(check_detector(detector), std::invalid_argument);
  detector = {};
  detector.pixels = PixelGrid{0, 10, 10};
  EXPECT_THROW(check_detector(detector), std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin
