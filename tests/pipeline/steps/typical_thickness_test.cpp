#include "pipeline/steps/typical_thickness.h"

#include <gtest/gtest.h>

#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

TEST(TypicalThickness, GrowsWithTheVolumeFrom30To90mm) {
  EXPECT_DOUBLE_EQ(typical_thickness_mm(50), 30);
  EXPECT_DOUBLE_EQ(typical_thickness_mm(360.4), 40);
  EXPECT_NEAR(typical_thickness_mm(617.65), 55, 1e-9);
  EXPECT_DOUBLE_EQ(typical_thickness_mm(5000), 90);
  for (double volume = 240; volume < 1500; volume += 20)
    EXPECT_GT(typical_thickness_mm(volume + 20), typical_thickness_mm(volume));
}

TEST(TypicalThickness, IsAssumedOfWhatLiesInFrontOfThePlates) {
  const MeshFile dome = dome_breast({4, 4, 2});
  PlateOptions plates;
  const double assumed = assumed_thickness_mm(dome, plates);
  EXPECT_NEAR(assumed, typical_thickness_mm(PlateFrame(dome, plates).volume_in_front() / 1000),
              1e-9);
  plates.wall_clearance = 40;
  EXPECT_LT(PlateFrame(dome, plates).volume_in_front(), 100e3);
  EXPECT_GE(assumed_thickness_mm(dome, plates), 0.25 * free_thickness(dome, plates));
}

}  // namespace
}  // namespace mammotwin
