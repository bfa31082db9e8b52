#include "segmentation/chest_wall/pectoral_wall.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

/// Ten rows of 60 rays from -88.5 to 88.5 degrees, 17 of them within 50 degrees of one side; the
/// muscle behind all of them has brightness 1.5.
PectoralWall even_wall() {
  constexpr double degree = 0.017453292519943295;
  PectoralWall wall;
  wall.angles = 60, wall.rows = 10;
  wall.first_angle = -88.5 * degree, wall.angle_step = 3 * degree;
  wall.z_step = 2;
  wall.radius.assign(600, 100);
  wall.cost.assign(600, -2);
  wall.behind.assign(600, 1.5F);
  wall.contrast.assign(600, {1, 1.5});
  return wall;
}

TEST(PectoralWall, FatBehindItIsCountedOnItsOwnSideOnly) {
  PectoralWall wall = even_wall();
  EXPECT_EQ(wall.fat_behind(Side::left, 0, 18), 0);
  for (int n = 0; n < 2 * 60; ++n)            // two rows of ten
    if (n % 60 >= 30) wall.behind[n] = 1.0F;  // the patient's left
  EXPECT_NEAR(wall.fat_behind(Side::left, 0, 18), 0.2, 1e-12);
  EXPECT_EQ(wall.fat_behind(Side::right, 0, 18), 0);
  EXPECT_EQ(wall.fat_behind(Side::left, 4, 18), 0) << "rows below 4 mm left out";
  EXPECT_EQ(wall.doubt(Side::left, 0, 18), 0) << "the edges are good";
}

TEST(PectoralWall, BoneBehindTheThinMuscleOfTheBreastboneIsNoFault) {
  PectoralWall wall = even_wall();
  for (int n = 0; n < 600; ++n)
    if (n % 60 >= 30 && n % 60 < 34) wall.behind[n] = 1.0F;  // 1.5 to 10.5 degrees
  EXPECT_EQ(wall.fat_behind(Side::left, 0, 18), 0);
}

TEST(PectoralWall, WhatAPersonDrewIsNotDoubted) {
  PectoralWall wall = even_wall();
  wall.cost.assign(600, 0);
  EXPECT_EQ(wall.doubt(Side::left, 0, 18), 1);
  wall.drawn.assign(600, 0);
  for (int n = 0; n < 5 * 60; ++n) wall.drawn[n] = 1;
  EXPECT_EQ(wall.doubt(Side::left, 0, 18), 1) << "what is left";
  wall.drawn.assign(600, 1);
  EXPECT_EQ(wall.doubt(Side::left, 0, 18), 0);
  EXPECT_EQ(wall.fat_behind(Side::left, 0, 18), 0);
}

TEST(PectoralWall, FatIsBrighterThanMuscleWithoutSuppression) {
  PectoralWall wall = even_wall();
  wall.contrast.assign(600, {1, 0.4});
  wall.behind.assign(600, 0.5F);  // the middle by logarithm is sqrt(0.4) = 0.63
  EXPECT_EQ(wall.fat_behind(Side::left, 0, 18), 0);
  wall.behind.assign(600, 0.7F);
  EXPECT_EQ(wall.fat_behind(Side::left, 0, 18), 1);
}

}  // namespace
}  // namespace mammotwin
