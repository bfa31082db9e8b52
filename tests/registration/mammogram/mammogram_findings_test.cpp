#include "registration/mammogram/mammogram_findings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "registration/mammogram/mammogram_picture.h"

namespace mammotwin {
namespace {

constexpr double kPixel_mm = 0.4;

struct Drawing {
  bool muscle = false, marker = false, nipple = false, strip = false, frame = false;
  float air = 0, noise = 0;
};

/// Half an ellipse of breast on the left edge (120 x 256 mm), and what a drawing asks for: a
/// brighter triangle of muscle, a marker, a nipple 6 mm proud of the skin at row 340, a strip of
/// abdomen, the dark frame of an exposed field.
MammogramImage drawn(const Drawing& d) {
  MammogramImage image{500, 700, std::vector<float>(500 * 700, d.air)};
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0, d.noise);
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column) {
      float& grey = image.at(column, row);
      if (std::hypot(column / 300.0, (row - 330) / 320.0) < 1) grey = 80;
      if (d.nipple && std::hypot(column - 300, row - 340) < 15) grey = 80;
      if (d.strip && row > 620 && column < 60) grey = 80;
      if (d.muscle && row < 100 && column < 260) grey = 80;
      if (d.muscle && column < 150 * (1 - row / 400.0)) grey = 160;
      if (row > 20 && row < 30 && column > 400 && column < 440) grey = 230;  // a label
      if (d.marker && std::hypot(column - 290, row - 380) < 5) grey = 255;
      if (d.noise > 0) grey += noise(random);
      if (d.frame && column > 450) grey = -20;
    }
  return image;
}

bool unsure(const MammogramFindings& found, const char* what) {
  return std::count(found.unsure.begin(), found.unsure.end(), what) > 0;
}

/// Worst distance of the outline from the drawn ellipse, as far as it is 20 rows off its ends [mm].
double worst_outline(const MammogramFindings& found) {
  double worst = 0;
  for (const Eigen::Vector2d& x : found.outline) {
    const double height = (x.y() - 330) / 320.0;
    if (std::abs(height) > 0.9) continue;
    worst = std::max(worst, std::abs(x.x() - 300 * std::sqrt(1 - height * height)) * kPixel_mm);
  }
  return worst;
}

TEST(MammogramFindings, SmoothBreastHasAnOutlineAndANippleThatIsUnsure) {
  const MammogramFindings found = find_breast(drawn({}), kPixel_mm, false);
  EXPECT_EQ(found.chest_wall, ImageEdge::left);
  EXPECT_EQ(found.evidence, NippleEvidence::not_in_profile);
  EXPECT_TRUE(unsure(found, "nipple"));
  EXPECT_GT(found.nipple_sd_mm, 10);   // nothing tells where it is
  EXPECT_LT(worst_outline(found), 1);  // two pixels
  EXPECT_FALSE(found.pectoral.has_value());
}

TEST(MammogramFindings, AirMayBeGreyNoisyAndFramed) {
  for (const Drawing& d : {Drawing{.air = 40}, Drawing{.air = 30, .noise = 2},
                           Drawing{.frame = true, .air = 30, .noise = 2}})
    EXPECT_LT(worst_outline(find_breast(drawn(d), kPixel_mm, false)), 1) << d.air << d.noise;
}

TEST(MammogramFindings, ThinWhiteBorderChangesNothing) {
  for (const int factor : {1, 4}) {  // pixels of 0.4 mm, and of 0.1 mm
    const MammogramImage coarse = drawn({.nipple = true, .noise = 2});
    MammogramImage fine{500 * factor, 700 * factor, {}};
    for (int row = 0; row < fine.rows; ++row)
      for (int column = 0; column < fine.columns; ++column) {
        const int edge = std::min({column, row, fine.columns - 1 - column, fine.rows - 1 - row});
        fine.grey.push_back(edge < 2 ? 255 : coarse.at(column / factor, row / factor));
      }
    const double pixel_mm = kPixel_mm / factor;
    const MammogramFindings found = find_breast(fine, pixel_mm, false);
    EXPECT_FALSE(unsure(found, "nipple"));
    EXPECT_LT((found.nipple / factor - Eigen::Vector2d(314, 340)).norm() * kPixel_mm, 2.5);
    // From chest wall to chest wall: the breast goes on beneath the border.
    EXPECT_LT(found.outline.front().x() / factor, 60);
    EXPECT_LT(found.outline.back().x() / factor, 60);
  }
}

TEST(MammogramFindings, DarkLinesAlongTheEdgesAreNoAir) {
  MammogramImage image = drawn({.muscle = true});
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column)
      if (std::min(column, row) < 3) image.at(column, row) = 0;  // 1.2 mm at chest wall and top
  const MammogramFindings found = find_breast(image, kPixel_mm, true);
  EXPECT_FALSE(unsure(found, "outline"));
  for (const Eigen::Vector2d& x : found.outline) EXPECT_GT(std::min(x.x(), x.y()), 4.5);
  EXPECT_LT(found.outline.back().x(), 20);  // from the top all the way to the chest wall
}

TEST(MammogramFindings, NippleNearTheLowerEndIsNoFold) {
  MammogramImage image = drawn({});
  const Eigen::Vector2d nipple(148, 622);  // on the skin near its lower end
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column)
      if ((Eigen::Vector2d(column, row) - nipple).norm() < 17) image.at(column, row) = 80;
  const MammogramFindings found = find_breast(image, kPixel_mm, false);
  EXPECT_LT(found.outline.back().x(), 20) << "cut off at the nipple";
  EXPECT_GT(found.outline.back().y(), 640);
}

TEST(MammogramFindings, RaggedOutlineIsUnsureAndWeighsLess) {
  MammogramImage image = drawn({});
  std::mt19937 random(3);
  std::uniform_int_distribution<int> depth(-10, 10), length(8, 14);
  for (int row = 0, end = 0, off = 0; row < image.rows; ++row) {
    if (row == end) {
      off = depth(random);
      end += length(random);
    }
    for (int column = 0; column < 400; ++column)
      image.at(column, row) = std::hypot((column + off) / 300.0, (row - 330) / 320.0) < 1 ? 80 : 0;
  }
  const MammogramFindings ragged = find_breast(image, kPixel_mm, false);
  const MammogramFindings smooth = find_breast(drawn({}), kPixel_mm, false);
  EXPECT_TRUE(unsure(ragged, "outline"));
  EXPECT_FALSE(unsure(smooth, "outline"));
  EXPECT_GT(ragged.outline_sd_mm, 4 * smooth.outline_sd_mm);
}

TEST(MammogramFindings, NippleInProfileIsFoundAndSure) {
  const MammogramFindings found = find_breast(drawn({.nipple = true}), kPixel_mm, false);
  EXPECT_EQ(found.evidence, NippleEvidence::profile);
  EXPECT_FALSE(unsure(found, "nipple"));
  // The tip's 15 pixels' round is flat to a pixel over 11 rows; the outline is smoothed over 2 mm.
  EXPECT_LT((found.nipple - Eigen::Vector2d(314, 340)).norm() * kPixel_mm, 2.5);
}

TEST(MammogramFindings, AbdomenBelowTheBreastIsCutOffAndSaid) {
  const MammogramFindings found = find_breast(drawn({.strip = true}), kPixel_mm, false);
  EXPECT_FALSE(found.remarks.empty());
  EXPECT_LT(found.outline.back().y(), 655);  // the breast ends at row 650, the strip at 700
}

TEST(MammogramFindings, AbdomenThatDoesNotRiseAgainBehindTheFoldIsCutOff) {
  MammogramImage image{500, 700, std::vector<float>(500 * 700, 0)};
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column)
      if (std::hypot(column / 300., (row - 270) / 240.) < 1 ||
          std::hypot(column - 300, row - 300) < 15 ||
          (row > 350 && column < 110 - 0.1 * (row - 350)))
        image.at(column, row) = 80;
  const MammogramFindings found = find_breast(image, kPixel_mm, true);
  EXPECT_EQ(found.remarks.front(),
            "below the breast the abdomen is cut off at a corner of the skin");
  EXPECT_NEAR(found.outline.back().y(), 494, 15);  // where the ellipse meets the abdomen
  EXPECT_LT((found.nipple - Eigen::Vector2d(314, 300)).norm() * kPixel_mm, 2.5);
}

TEST(MammogramFindings, MirroredImageHasItsChestWallRight) {
  const MammogramImage image = drawn({.marker = true});
  MammogramImage mirrored = image;
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column)
      mirrored.at(column, row) = image.at(499 - column, row);
  const MammogramFindings found = find_breast(mirrored, kPixel_mm, false);
  EXPECT_EQ(found.chest_wall, ImageEdge::right);
  EXPECT_NEAR(found.nipple.x(), 499 - 290, 1);
}

TEST(MammogramFindings, MarkerIsTheNipple) {
  const MammogramFindings found = find_breast(drawn({.marker = true}), kPixel_mm, false);
  EXPECT_EQ(found.evidence, NippleEvidence::marker);
  EXPECT_LT((found.nipple - Eigen::Vector2d(290, 380)).norm(), 1);
}

TEST(MammogramFindings, PectoralEdgeOfADrawnMuscle) {
  const MammogramFindings found = find_breast(drawn({.muscle = true}), kPixel_mm, true);
  ASSERT_TRUE(found.pectoral.has_value());
  for (const Eigen::Vector2d& x : found.pectoral_curve) {
    if (x.y() > 360) continue;  // its last 16 mm are the corner at the chest wall
    // A step without noise is as clear over the reach of 3 mm to either side.
    EXPECT_NEAR(x.x(), 150 * (1 - x.y() / 400), 15) << x.y();  // 6 mm
  }
}

TEST(MammogramFindings, PectoralEdgeBelowRowsThatATurnLeftEmpty) {
  MammogramImage image = drawn({.muscle = true});
  for (int row = 0; row < 25; ++row)  // 10 mm at the chest wall, none 250 columns from it
    for (int column = 0; column < image.columns; ++column)
      if (row < 25 - column / 10) image.at(column, row) = 0;
  const MammogramFindings found = find_breast(image, kPixel_mm, true);
  ASSERT_TRUE(found.pectoral.has_value());
  for (const Eigen::Vector2d& x : found.pectoral_curve)
    if (x.y() > 40 && x.y() < 360) {
      EXPECT_NEAR(x.x(), 150 * (1 - x.y() / 400), 15) << x.y();
    }
}

TEST(MammogramFindings, MuscleInAViewCalledCcIsDoubtAndItsAbsenceInAnMloToo) {
  EXPECT_TRUE(unsure(find_breast(drawn({.muscle = true}), kPixel_mm, false), "view"));
  const MammogramFindings bare = find_breast(drawn({}), kPixel_mm, true);
  EXPECT_TRUE(unsure(bare, "pectoral"));
  EXPECT_TRUE(unsure(bare, "view"));
  EXPECT_FALSE(unsure(find_breast(drawn({.muscle = true}), kPixel_mm, true), "view"));
  EXPECT_FALSE(unsure(find_breast(drawn({}), kPixel_mm, false), "view"));
}

TEST(MammogramFindings, WhatIsSaidGoesBeforeWhatIsSeen) {
  SaidFindings said;
  said.nipple = Eigen::Vector2d(250, 300);
  said.pectoral = {{100, 0}, {0, 300}};
  said.outline = {{0, 20}, {200, 100}, {290, 330}, {200, 560}, {0, 640}};
  const MammogramFindings found = find_breast(drawn({.muscle = true}), kPixel_mm, true, said);
  EXPECT_EQ(found.nipple, *said.nipple);
  EXPECT_EQ(found.evidence, NippleEvidence::said);
  EXPECT_EQ(found.pectoral->first, said.pectoral->first);
  ASSERT_EQ(found.outline.size(), said.outline.size());
  EXPECT_LT((found.outline[2] - said.outline[2]).norm(), 1e-9);
}

TEST(MammogramFindings, RefuseWhatShowsNoBreast) {
  MammogramImage empty{100, 100, std::vector<float>(10000, 0)};
  empty.grey[5050] = 200;
  EXPECT_THROW(find_breast(empty, kPixel_mm, false), std::runtime_error);
  MammogramImage full = drawn({.air = 100});  // what is bright lies at all edges
  EXPECT_THROW(find_breast(full, kPixel_mm, false), std::runtime_error);
  EXPECT_THROW(read_mammogram_picture("absent.png"), std::runtime_error);
}

}  // namespace
}  // namespace mammotwin
