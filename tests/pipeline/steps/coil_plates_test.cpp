#include "pipeline/steps/coil_plates.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

/// A breast 70 mm deep and 100 mm high whose sides stand 60 mm apart in the middle and come nearer
/// by `narrowing` over its depth; turned about the body's axis.
MeshFile pressed_breast(double narrowing, double turn_deg) {
  const Eigen::AngleAxisd turn(turn_deg * std::numbers::pi / 180, Eigen::Vector3d::UnitZ());
  MeshFile breast = dome_breast({3, 3, 2});
  breast.mesh = mapped_mesh({3, 3, 2}, [&](const Eigen::Vector3d& xi) {
    const double width = 60 + narrowing * (0.5 - xi.z());
    return (turn * Eigen::Vector3d(width * (xi.x() - 0.5), -70 * xi.z(), 100 * xi.y())).eval();
  });
  for (FaceLabels& faces : breast.faces)
    for (const int side : {0, 1})
      if (faces[side] == FaceLabel::cut) faces[side] = FaceLabel::skin;
  return breast;
}

TEST(CoilPlates, AreFoundOnBothSidesHoweverTheBodyIsTurned) {
  for (const double turn : {0.0, 5.0, -20.0}) {
    const auto plates = find_coil_plates(pressed_breast(0, turn));
    ASSERT_TRUE(plates) << turn;
    EXPECT_NEAR(plates->apart_mm, 60, 1e-6);
    EXPECT_NEAR(plates->left_cm2, 70, 1e-6);
    EXPECT_NEAR(plates->right_cm2, 70, 1e-6);
  }
}

TEST(CoilPlates, AreNotSeenInSidesThatAreNotParallel) {
  EXPECT_FALSE(find_coil_plates(pressed_breast(30, 0)));  // 24 degrees
  EXPECT_TRUE(find_coil_plates(pressed_breast(6, 0)));
}

TEST(CoilPlates, PressOnTheirSkinOnly) {
  const auto plates = find_coil_plates(pressed_breast(0, 0));
  ASSERT_TRUE(plates);
  const SkinPressure pressure = pressure_of(*plates, 0.4);
  const Eigen::Vector3d left = Eigen::Vector3d::UnitX();
  EXPECT_NEAR(pressure({30, -20, 50}, left), 0.4, 1e-9);
  EXPECT_NEAR(pressure({31.5, -20, 50}, left), 0.2, 1e-9) << "the plate's rim";
  EXPECT_EQ(pressure({33, -20, 50}, left), 0);
  EXPECT_EQ(pressure({30, -20, 50}, -Eigen::Vector3d::UnitY()), 0) << "the tip";
  EXPECT_NEAR(pressure({-30, -20, 50}, -left), 0.4, 1e-9);
}

TEST(CoilPlates, AreNotSeenInADome) { EXPECT_FALSE(find_coil_plates(dome_breast({4, 4, 2}))); }

}  // namespace
}  // namespace mammotwin
