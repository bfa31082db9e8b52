#include "pipeline/evaluate/registration/mammogram_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace mammotwin {
namespace {

/// Of 500 columns, its muscle wide above at a slope of 40 in 100, which meets the edge in row 200.
ReadMammogram read(double nipple_row) {
  ReadMammogram read;
  read.pixel_mm = 0.5;
  read.pectoral = {Eigen::Vector2d(80, 0), Eigen::Vector2d(20, 150)};
  read.nipple = {300, nipple_row};
  return read;
}

using Line = std::vector<Eigen::Vector2d>;
const Line kOutline{{370, 100}, {250, 700}};  // slanted by 20 in 100

ReadMammogram mirrored(ReadMammogram read) {
  read.wall_at_left = false;
  for (Eigen::Vector2d* x : {&read.pectoral->first, &read.pectoral->second, &*read.nipple})
    x->x() = 499 - x->x();
  return read;
}

Line mirrored(Line line) {
  for (Eigen::Vector2d& x : line) x.x() = 499 - x.x();
  return line;
}

TEST(PositioningRow, SaysHowDeepTheNippleLiesOverItsDistanceFromTheMuscle) {
  const double slope = std::atan(0.4);
  for (const double below : {-50.0, 0.0, 120.0}) {
    const nlohmann::json row = positioning_row(read(200 + below), kOutline, 500);
    EXPECT_NEAR(row.at("muscle_slope_deg").get<double>(), slope * 180 / M_PI, 1e-9);
    EXPECT_NEAR(row.at("nipple_share").get<double>(),
                300 / (300 * std::cos(slope) + below * std::sin(slope)), 1e-9);
    EXPECT_NEAR(row.at("skin_slope_deg").get<double>(), std::atan(0.2) * 180 / M_PI, 1e-9);
    EXPECT_EQ(row, positioning_row(mirrored(read(200 + below)), mirrored(kOutline), 500));
  }
}

TEST(PositioningRow, SaysNoSlopeOfSkinThatDoesNotReach) {
  EXPECT_FALSE(positioning_row(read(640), kOutline, 500).at("skin_slope_deg").is_null());
  for (const double row : {140.0, 660.0})  // 50 pixels each way
    EXPECT_TRUE(positioning_row(read(row), kOutline, 500).at("skin_slope_deg").is_null());
}

TEST(PositioningRow, MeasuresTheSkinWhereItIsDeepest) {
  const Line folded{{370, 100}, {350, 180}, {200, 180}, {200, 120}, {340, 120}, {250, 700}};
  EXPECT_NEAR(positioning_row(read(200), folded, 500).at("skin_slope_deg").get<double>(),
              std::atan2(357.5 - (340 - 90 * 130 / 580.), 100) * 180 / M_PI, 1e-9);
}

TEST(PositioningRow, SaysNothingWhereNobodyReadTheMuscleOrTheNipple) {
  ReadMammogram without = read(200);
  without.nipple.reset();
  EXPECT_TRUE(positioning_row(without, kOutline, 500).empty());
  without = read(200);
  without.pectoral.reset();
  EXPECT_TRUE(positioning_row(without, kOutline, 500).empty());
}

/// 100 by 160 mm in pixels of half a millimetre: breast in a half disc of 60 mm, brighter muscle
/// above a line of 20 degrees.
MammogramImage breast_below_muscle(bool muscle) {
  MammogramImage image{200, 320, std::vector<float>(200 * 320, 0)};
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column) {
      const double x = column / 2., y = row / 2.;  // mm
      const bool breast = std::hypot(x, y - 90) < 60 || (y < 60 && x < 52);
      const bool above = muscle && x < 0.36 * (100 - y);
      image.at(column, row) = !breast ? 0 : above ? 0.8f : 0.4f;
    }
  return image;
}

TEST(NoticedRow, SaysWhetherAnotherNameOfTheViewOrItsOtherHangingIsNoticed) {
  ReadMammogram mlo;
  mlo.view = "mlo";
  mlo.pixel_mm = 0.5;
  const MammogramImage with = breast_below_muscle(true), without = breast_below_muscle(false);
  EXPECT_EQ(noticed_row(mlo, with),
            nlohmann::json({{"other_view_noticed", true}, {"upside_down_noticed", true}}));
  EXPECT_EQ(noticed_row(mlo, without).at("other_view_noticed"), false);
  const auto doubted = [&](const MammogramImage& image) {
    return mammogram_row(mlo, find_breast(image, mlo.pixel_mm, true)).at("view_doubted");
  };
  EXPECT_EQ(doubted(with), false);
  EXPECT_EQ(doubted(without), true);
}

}  // namespace
}  // namespace mammotwin
