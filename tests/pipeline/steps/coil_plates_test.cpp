#include "pipeline/steps/coil_plates.h"

#include <gtest/gtest.h>

#include "tests/pipeline/steps/pressed_breast.h"

namespace mammotwin {
namespace {

TEST(CoilPlates, AreFoundOnBothSidesHoweverTheBodyIsTurned) {
  for (const double turn : {0.0, 5.0, -20.0}) {
    const auto plates = find_coil_plates(pressed_breast(0, turn));
    ASSERT_TRUE(plates) << turn;
    EXPECT_NEAR(plates->apart_mm, 60, 1e-6);
    EXPECT_NEAR(plates->left_cm2, 70, 1e-6);
    EXPECT_NEAR(plates->right_cm2, 70, 1e-6);
  }
}

// Many pairs of patches are as large: what is found must not hang on their order.
TEST(CoilPlates, OfTheMirrorImageAreTheMirrorImages) {
  for (const double narrowing : {0.0, 6.0}) {
    const auto one = find_coil_plates(pressed_breast(narrowing, 5));
    const auto other = find_coil_plates(pressed_breast(narrowing, -5));
    ASSERT_TRUE(one && other);
    EXPECT_NEAR(one->across.x(), other->across.x(), 1e-9);
    EXPECT_NEAR(one->across.y(), -other->across.y(), 1e-9);
    EXPECT_NEAR(one->left_cm2, other->right_cm2, 1e-9);
    EXPECT_NEAR(one->right_cm2, other->left_cm2, 1e-9);
    EXPECT_NEAR(one->apart_mm, other->apart_mm, 1e-9);
  }
}

TEST(CoilPlates, AreNotSeenInSidesThatAreNotParallel) {
  EXPECT_FALSE(find_coil_plates(pressed_breast(30, 0)));  // 24 degrees
  EXPECT_TRUE(find_coil_plates(pressed_breast(6, 0)));
}

TEST(CoilPlates, AreNotSeenInADome) { EXPECT_FALSE(find_coil_plates(dome_breast({4, 4, 2}))); }

}  // namespace
}  // namespace mammotwin
