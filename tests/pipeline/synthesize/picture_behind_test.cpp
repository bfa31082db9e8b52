#include "pipeline/synthesize/views/picture_behind.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

constexpr double kPlates_mm = 50, kSkin_mm = 60;
constexpr int kSeenRows = 40;
constexpr double kFatPer_mm = Attenuation().fat, kMusclePer_mm = Attenuation().lesion;

/// Pixels of 1 mm of fat, v from -20 upwards: no tissue for 5 mm at the detector's edge, thin or
/// swollen to 20 mm, 50 mm thick to the skin's rim 10 mm from its end. The first ten rows are thin
/// as a breast's end is.
SimulatedView fat_between_plates() {
  DetectorImage thickness{80, kSeenRows, 1, {0.5, -19.5}, {}};
  for (int j = 0; j < thickness.rows; ++j)
    for (int i = 0; i < thickness.columns; ++i) {
      const double rear = j % 2 ? 25 : 65, end = j < 10 ? 0.2 : 1;
      thickness.values.push_back(end * (i < 5               ? 0
                                        : i < 20            ? rear
                                        : i < kSkin_mm - 10 ? kPlates_mm
                                        : i < kSkin_mm      ? 5 * (kSkin_mm - i)
                                                            : 0));
    }
  SimulatedView view{thickness, thickness};
  for (double& a : view.attenuation.values) a *= kFatPer_mm;
  return view;
}

TEST(PictureBehind, FillsTheRearBetweenThePlatesAndLeavesTheRimToTheSkin) {
  const SimulatedView view = fat_between_plates();
  const DetectorImage picture = picture_behind(view, kPlates_mm, {}, -150);
  ASSERT_EQ(picture.rows, kSeenRows);
  for (int j = 10; j < picture.rows; ++j)
    for (int i = 0; i < picture.columns; ++i)
      EXPECT_NEAR(picture.at(i, j), i < 50 ? kPlates_mm * kFatPer_mm : view.attenuation.at(i, j),
                  1e-12)
          << i << " " << j;
}

TEST(PictureBehind, ShowsMuscleBehindItsStraightEdgeAndTissueUpToTheImagesTop) {
  // through (0, 20) and (20, -20)
  const Eigen::Vector2d squarely = Eigen::Vector2d(2, 1).normalized();
  const double top_v_mm = -30;
  const DetectorImage picture =
      picture_behind(fat_between_plates(), kPlates_mm, MuscleEdge{{0, 20}, squarely}, top_v_mm);
  ASSERT_EQ(picture.rows, kSeenRows + 11);
  EXPECT_NEAR(picture.first.y(), -30.5, 1e-12);
  for (int j = 0; j < picture.rows; ++j)
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector2d uv = picture.first + Eigen::Vector2d(i, j);
      const double before_mm = squarely.dot(uv - Eigen::Vector2d(0, 20));
      const double per_mm = picture.at(i, j) / kPlates_mm;
      if (before_mm > 0) {
        EXPECT_NEAR(per_mm, kFatPer_mm, 1e-12) << uv.transpose();
      }
      if (before_mm < -8) {
        EXPECT_NEAR(per_mm, 0.3 * kFatPer_mm + 0.7 * kMusclePer_mm, 1e-12) << uv.transpose();
      }
    }
}

TEST(PictureBehind, LeavesTissueBeforeAMuscleWhoseLineWouldCoverTheImagesTop) {
  const Eigen::Vector2d squarely = Eigen::Vector2d(1, 1).normalized();
  const double top_v_mm = -100;  // where the line is 120 mm deep
  const DetectorImage picture =
      picture_behind(fat_between_plates(), kPlates_mm, MuscleEdge{{0, 20}, squarely}, top_v_mm);
  EXPECT_GT(picture.at(10, 0), kPlates_mm * (kFatPer_mm + kMusclePer_mm) / 2);
  EXPECT_NEAR(picture.at(40, 0), kPlates_mm * kFatPer_mm, 1e-12);  // 36 mm is 0.6 of what is there
  EXPECT_NEAR(picture.at(2, picture.rows - 1), kPlates_mm * kFatPer_mm, 1e-12) << "where they meet";
}

TEST(PictureBehind, AddsNoRowToABreastThatReachesBeyondTheImagesTop) {
  const SimulatedView view = fat_between_plates();
  const MuscleEdge edge{{0, 20}, Eigen::Vector2d(2, 1).normalized()};
  const DetectorImage picture = picture_behind(view, kPlates_mm, edge, -15);
  EXPECT_EQ(picture.rows, kSeenRows);
  EXPECT_EQ(picture.first, view.attenuation.first);
  EXPECT_GT(picture.at(2, 0), 1.2 * picture.at(2, kSeenRows - 1)) << "muscle is above";
}

TEST(PictureBehind, IsTheMirrorImageWhereTheTopIsTheOtherEnd) {
  const Eigen::Vector2d squarely = Eigen::Vector2d(2, 1).normalized();
  const SimulatedView view = fat_between_plates();
  SimulatedView turned = view;
  for (int j = 0; j < view.thickness.rows; ++j)
    for (int i = 0; i < view.thickness.columns; ++i) {
      const std::size_t from = static_cast<std::size_t>(j) * 80 + i;
      const std::size_t to = static_cast<std::size_t>(view.thickness.rows - 1 - j) * 80 + i;
      turned.thickness.values[to] = view.thickness.values[from];
      turned.attenuation.values[to] = view.attenuation.values[from];
    }
  const DetectorImage one = picture_behind(view, kPlates_mm, MuscleEdge{{0, 20}, squarely}, -30);
  const DetectorImage other =
      picture_behind(turned, kPlates_mm, MuscleEdge{{0, -20}, {squarely.x(), -squarely.y()}}, 30);
  ASSERT_EQ(one.rows, other.rows);
  EXPECT_NEAR(other.first.y(), -19.5, 1e-12) << "rows were added behind the last";
  for (int j = 0; j < one.rows; ++j)
    for (int i = 0; i < one.columns; ++i)
      EXPECT_NEAR(one.at(i, j), other.at(i, one.rows - 1 - j), 1e-12) << i << " " << j;
}

}  // namespace
}  // namespace mammotwin
