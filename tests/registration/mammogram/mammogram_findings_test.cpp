#include "registration/mammogram/mammogram_findings.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

/// Half an ellipse of breast on the left edge, brighter triangle of muscle, optionally a marker.
MammogramImage drawn(bool muscle, bool marker) {
  MammogramImage image{500, 650, std::vector<float>(500 * 650, 0)};
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column) {
      float& grey = image.grey[static_cast<std::size_t>(row) * image.columns + column];
      if (std::hypot(column / 300.0, (row - 330) / 320.0) < 1) grey = 80;
      if (muscle && row < 100 && column < 260) grey = 80;
      if (muscle && column < 150 * (1 - row / 400.0)) grey = 160;
      if (marker && std::hypot(column - 290, row - 380) < 5) grey = 255;
    }
  return image;
}

TEST(MammogramFindings, OutlineAndProfileOfADrawnBreast) {
  const MammogramFindings found = find_breast(drawn(false, false), false);
  EXPECT_EQ(found.chest_wall, ImageEdge::left);
  EXPECT_EQ(found.evidence, NippleEvidence::profile);
  // The ellipse's tip; blur and threshold move the skin by about a blur of 2 pixels twice.
  EXPECT_NEAR(found.nipple.x(), 300, 4);
  EXPECT_NEAR(found.nipple.y(), 330, 25);  // flat there: 1 pixel in 300 over 25 rows
  EXPECT_FALSE(found.pectoral.has_value());
}

TEST(MammogramFindings, MirroredImageHasItsChestWallRight) {
  MammogramImage image = drawn(false, true), mirrored = image;
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column)
      mirrored.grey[static_cast<std::size_t>(row) * 500 + column] = image.at(499 - column, row);
  const MammogramFindings found = find_breast(mirrored, false);
  EXPECT_EQ(found.chest_wall, ImageEdge::right);
  EXPECT_NEAR(found.nipple.x(), 499 - 290, 1);
}

TEST(MammogramFindings, MarkerIsTheNipple) {
  const MammogramFindings found = find_breast(drawn(false, true), false);
  EXPECT_EQ(found.evidence, NippleEvidence::marker);
  EXPECT_LT((found.nipple - Eigen::Vector2d(290, 380)).norm(), 1);
}

TEST(MammogramFindings, PectoralEdgeOfADrawnMuscle) {
  const MammogramFindings found = find_breast(drawn(true, false), true);
  ASSERT_TRUE(found.pectoral.has_value());
  EXPECT_NEAR(found.pectoral->first.x(), 150, 8);    // lines are tried 4 pixels apart
  EXPECT_NEAR(found.pectoral->second.y(), 400, 16);  // and 8 rows
}

TEST(MammogramFindings, RefuseAnEmptyImageAndAMissingFile) {
  MammogramImage empty{100, 100, std::vector<float>(10000, 0)};
  empty.grey[5050] = 200;
  EXPECT_THROW(find_breast(empty, false), std::runtime_error);
  EXPECT_THROW(read_mammogram_png("absent.png"), std::runtime_error);
}

}  // namespace
}  // namespace mammotwin
