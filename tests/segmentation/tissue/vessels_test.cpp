#include "segmentation/tissue/vessels.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mammotwin {
namespace {

/// A cube of fat with a slab of gland (1.8 of fat) of 30 x 60 x 16 mm at its top, and a tube along
/// x, `height` of fat and 4 mm wide, from x = 10 to `end`, at z = `z`.
struct TubeInBreast {
  TissueSplit split;
  Volume<std::uint8_t> interior;

  TubeInBreast(float height, double end, double z = 20) {
    Volume<float> image({60, 60, 60}, Eigen::Vector3d::Ones(), {0, 0, 0}, 1);
    interior = image.like<std::uint8_t>(1);
    split.gland_fraction = image.like<float>(0);
    split.gland = 1.8;
    for (int k = 0; k < 60; ++k)
      for (int j = 0; j < 60; ++j)
        for (int i = 0; i < 60; ++i) {
          const bool gland = k >= 44 && i >= 20 && i < 50;
          const bool tube = i >= 10 && i <= end && std::hypot(j - 30, k - z) < 2;
          if (gland) image(i, j, k) = 1.8F;
          if (tube) image(i, j, k) = height;
          split.gland_fraction(i, j, k) = gland || tube ? 1.0F : 0.0F;
        }
    split.corrected = image;
  }

  double found_ml(const Volume<float>& enhancement = {}) const {
    const Volume<std::uint8_t> vessels = find_vessels(split, interior, enhancement);
    return std::count(vessels.values.begin(), vessels.values.end(), 1) * 1e-3;
  }
  float gland_after(int i, int j, int k) {
    take_as_surroundings(find_vessels(split, interior, {}), interior, split);
    return split.gland_fraction(i, j, k);
  }
};

TEST(Vessels, AreLongBrightTubesInFat) {
  TubeInBreast breast(4, 50);
  // 41 mm of a section of 3.14 x 2^2 mm^2, or of up to 3.14 x 3.5^2 with what lies around its core.
  EXPECT_GT(breast.found_ml(), 41 * 3.14 * 4 * 1e-3);
  EXPECT_LT(breast.found_ml(), 45 * 3.14 * 3.5 * 3.5 * 1e-3);
  EXPECT_LT(breast.gland_after(30, 30, 20), 0.01F) << "fat, as what lies round it";
  EXPECT_EQ(breast.gland_after(30, 30, 50), 1) << "gland stays";
}

TEST(Vessels, AreNeitherShortNorAsBrightAsGland) {
  EXPECT_EQ(TubeInBreast(4, 18).found_ml(), 0) << "a node, or a duct full of fluid";
  EXPECT_EQ(TubeInBreast(1.8F, 50).found_ml(), 0) << "a strand of gland";
}

TEST(Vessels, AreWhatTakesUpAgentWhereThatIsKnown) {
  const TubeInBreast strand(4, 50), vessel(1.8F, 50);
  auto uptake = vessel.split.corrected.like<float>(0.2F);
  EXPECT_EQ(strand.found_ml(uptake), 0);
  for (int i = 10; i <= 50; ++i)
    for (int j = 28; j <= 32; ++j)
      for (int k = 18; k <= 22; ++k) uptake(i, j, k) = 2;
  EXPECT_GT(vessel.found_ml(uptake), 41 * 5 * 5 * 1e-3 * 0.9);
}

TEST(Vessels, CountInTheRegionOnly) {
  const Volume<std::uint8_t> all({10, 10, 10}, Eigen::Vector3d::Constant(2), {0, 0, 0}, 1);
  BreastRegion region;
  region.x_min = -1, region.x_max = 9;   // five of ten columns
  region.z_min = -1, region.z_max = 19;  // all slices
  EXPECT_DOUBLE_EQ(volume_in(region, all), 4);
}

TEST(Vessels, InGlandStayGland) {
  TubeInBreast breast(7, 50, 52);
  EXPECT_GT(breast.gland_after(35, 30, 52), 0.9F);
}

}  // namespace
}  // namespace mammotwin
