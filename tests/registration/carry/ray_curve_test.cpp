#include "registration/carry/ray_curve.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "registration/prediction/project_lesions.h"
#include "registration/search/search_ellipse.h"
#include "tests/registration/squeezed_box.h"

namespace mammotwin {
namespace {

ViewRays rays_of(const SqueezedBox& breast, const Detector& detector = {}) {
  return ViewRays(breast.prone, breast.compressed, breast.view, detector);
}

Eigen::Vector2d mark_of(const SqueezedBox& breast, const Eigen::Vector3d& prone) {
  return ViewProjection(breast.prone, breast.compressed, breast.view, Detector{})
      .project({"1", prone})
      .on_detector;
}

constexpr double kRoundTrip_mm = 1e-6;  // two inverse maps of 1e-9 mm, and a refinement to 1e-9 mm

TEST(ViewRays, CurveOfAMarkPassesThroughItsLesion) {
  for (const double angle : {0.0, 45.0}) {
    const SqueezedBox breast = squeezed_box(Side::right, angle, 0.5);
    const Eigen::Vector3d lesion(-66, -37, 11);
    const ViewRays rays = rays_of(breast);
    const Eigen::Vector2d mark = mark_of(breast, lesion);
    const double height = breast.view.frame.view_from_lps(breast.A * lesion + breast.b).z();
    const auto there = rays.at_height(mark, height);
    ASSERT_TRUE(there.has_value());
    EXPECT_LT((there->prone_in_lps - lesion).norm(), kRoundTrip_mm);
    EXPECT_LT((rays.project(there->point) - mark).norm(), kRoundTrip_mm);
  }
}

TEST(ViewRays, CurveRunsFromSupportToPaddleAndNowhereElse) {
  const SqueezedBox breast = squeezed_box(Side::left, 0, 0.5);  // 40 mm thick
  const auto curve = rays_of(breast).curve({30, 0}, 1);
  ASSERT_GE(curve.size(), 40u);
  EXPECT_NEAR(curve.front().height_mm, 0, 1);
  EXPECT_NEAR(curve.back().height_mm, 40, 1);
  EXPECT_TRUE(rays_of(breast).curve({300, 0}).empty());
}

TEST(ViewRays, SlopeIsTheDerivativeOfTheCurve) {
  const SqueezedBox breast = squeezed_box(Side::left, 45, 0.5);
  const ViewRays rays = rays_of(breast);
  const Eigen::Vector2d mark(40, 12);
  const double h = 0.1;  // the map is affine, so any step serves; rounding stays near 1e-8
  const auto low = rays.at_height(mark, 15 - h), at = rays.at_height(mark, 15),
             high = rays.at_height(mark, 15 + h);
  const Eigen::Vector3d difference = (high->prone_in_lps - low->prone_in_lps) / (2 * h);
  EXPECT_LT((rays.slope(mark, *at) - difference).norm(), 1e-6);
}

// Tissue at the lesion's height whose mark lies 10 mm from the lesion's; beyond the skin there is
// none.
TEST(ViewRays, AnEllipseInTheMriIsSeenAsTheEllipse) {
  const SqueezedBox breast = squeezed_box(Side::left, 45, 0.5);
  const ViewRays rays = rays_of(breast);
  const Eigen::Vector3d lesion(62, -33, 9);
  const Eigen::Vector2d mark = mark_of(breast, lesion);
  const double height = breast.view.frame.view_from_lps(breast.A * lesion + breast.b).z();
  const auto points = ellipse_in_prone(rays, mark, rim({10, 10, 0}, 12), height);
  ASSERT_EQ(points.size(), 12u);
  for (const Eigen::Vector3d& x : points) {
    EXPECT_NEAR((mark_of(breast, x) - mark).norm(), 10, kRoundTrip_mm);
    EXPECT_NEAR(breast.view.frame.view_from_lps(breast.A * x + breast.b).z(), height,
                kRoundTrip_mm);
  }
  EXPECT_TRUE(ellipse_in_prone(rays, mark, rim({300, 300, 0}, 12), height).empty());
}

TEST(ClosestApproach, OfTwoMarksOfOneLesionIsTheLesion) {
  const SqueezedBox cc = squeezed_box(Side::left, 0, 0.5), mlo = squeezed_box(Side::left, 45, 0.5);
  const ViewRays a = rays_of(cc), b = rays_of(mlo);
  for (const Eigen::Vector3d& lesion :
       {Eigen::Vector3d(62, -33, 9), Eigen::Vector3d(88, -20, -17)}) {
    const auto found = closest_approach(a, mark_of(cc, lesion), b, mark_of(mlo, lesion));
    ASSERT_TRUE(found.has_value());
    EXPECT_LT((found->prone_in_lps - lesion).norm(), kRoundTrip_mm);
    EXPECT_LT(found->gap_mm, kRoundTrip_mm);
  }
}

TEST(ClosestApproach, SaysHowFarMarksOfTwoLesionsMissEachOther) {
  const SqueezedBox cc = squeezed_box(Side::left, 0, 0.5), mlo = squeezed_box(Side::left, 45, 0.5);
  const auto found = closest_approach(rays_of(cc), mark_of(cc, {62, -33, 9}), rays_of(mlo),
                                      mark_of(mlo, {62, -48, 9}));
  ASSERT_TRUE(found.has_value());
  EXPECT_GT(found->gap_mm, 5);  // 15 mm apart in depth, which both views see
}

TEST(ClosestApproach, CurveInTheOtherViewPassesTheOtherMark) {
  const SqueezedBox cc = squeezed_box(Side::left, 0, 0.5), mlo = squeezed_box(Side::left, 45, 0.5);
  const Eigen::Vector3d lesion(62, -33, 9);
  const auto curve = curve_in_other_view(rays_of(cc), mark_of(cc, lesion), rays_of(mlo), 0.25);
  const Eigen::Vector2d other_mark = mark_of(mlo, lesion);
  double nearest = 1e9;
  for (const Eigen::Vector2d& uv : curve) nearest = std::min(nearest, (uv - other_mark).norm());
  EXPECT_LT(nearest, 0.5);  // sampled a quarter of a millimetre of height apart
}

}  // namespace
}  // namespace mammotwin
