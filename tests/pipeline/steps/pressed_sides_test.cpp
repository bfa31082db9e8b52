#include "pipeline/steps/pressed_sides.h"

#include <gtest/gtest.h>

#include "tests/pipeline/steps/pressed_breast.h"

namespace mammotwin {
namespace {

TEST(Roundness, IsWidthOverHeightOfTheFrontHalf) {
  const MeshFile breast = pressed_breast(0, 0);
  const Roundness roundness(breast, Eigen::Vector3d::UnitX());
  EXPECT_NEAR(roundness.of(breast.mesh.nodes()), 0.6, 1e-9);
  std::vector<HermiteMesh::Node> wider = breast.mesh.nodes();
  for (HermiteMesh::Node& node : wider) node.row(0) *= 1.5;
  EXPECT_NEAR(roundness.of(wider), 0.9, 1e-9);
}

TEST(PressedSides, AreSeenByTheirPlanesOrByAShapeThatNoneHas) {
  const auto plane = find_pressed_sides(pressed_breast(0, 5));
  ASSERT_TRUE(plane && plane->plates);
  EXPECT_NEAR(plane->across.x(), std::cos(5 * std::numbers::pi / 180), 1e-9);
  EXPECT_NEAR(plane->roundness, 0.6, 0.02) << "the front half is another after a turn";
  for (const double turn : {0.0, 5.0, -20.0}) {
    const auto narrow = find_pressed_sides(pressed_breast(25, turn, 50));  // no plane pair
    ASSERT_TRUE(narrow);
    EXPECT_FALSE(narrow->plates);
    EXPECT_NEAR(narrow->across.x(), std::cos(turn * std::numbers::pi / 180), 0.03);
    EXPECT_LT(narrow->roundness, 0.5);
  }
  EXPECT_FALSE(find_pressed_sides(dome_breast({4, 4, 2})));
}

TEST(PressedSides, AreBothAndNotTheSlopeOfOne) {
  MeshFile breast = pressed_breast(0, 0);
  breast.mesh = mapped_mesh({3, 3, 2}, [](const Eigen::Vector3d& xi) {
    const double steep = -30, slope = 90 - 60 * xi.z();  // it faces 41 degrees forward
    return Eigen::Vector3d(steep + xi.x() * (slope - steep), -70 * xi.z(), 100 * xi.y());
  });
  const double any = 10;
  const auto sides = find_pressed_sides(breast, any);
  ASSERT_TRUE(sides);
  EXPECT_GT(sides->across.x(), 0.9);
  EXPECT_FALSE(find_pressed_sides(breast));
}

TEST(PressedSides, TheMiddleOfEachGoesOutwardAndTheTipDoesNot) {
  const MeshFile breast = pressed_breast(0, 0);
  const PressedSkin skin = pressed_skin(breast, *find_pressed_sides(breast));
  const Eigen::Vector3d left = Eigen::Vector3d::UnitX();
  for (const double side : {1.0, -1.0}) {
    const Eigen::Vector3d middle(30 * side, -35, 50);
    const PressedSkin::Point point = skin.at(middle, side * left);
    EXPECT_NEAR(point.share, 1, 1e-6);
    EXPECT_NEAR(point.way, 1, 1e-6);
    EXPECT_EQ(point.outward, (side * left).eval());
    EXPECT_LT(skin.at(middle + Eigen::Vector3d(0, 0, 45), side * left).way, 0.6);
    EXPECT_EQ(skin.at(middle + Eigen::Vector3d(0, 0, 75), side * left).share, 0);
    EXPECT_EQ(skin.at(middle, -Eigen::Vector3d::UnitY()).share, 0) << "skin that faces forward";
  }
  EXPECT_EQ(skin.at({30, 5, 50}, left).share, 0) << "behind the wall";
}

}  // namespace
}  // namespace mammotwin
