#include "segmentation/skin/skin_slab.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

constexpr double voxel_mm = 1.2;

/// The profile that skin_slab.h describes, every quarter of a millimetre from -3 to 5.5.
SkinProfile profile_of(double thickness, double level, double surface, double blur_voxels) {
  const double sigma = blur_voxels * voxel_mm;
  const auto step = [&](double x) { return 0.5 * std::erfc(-x / (std::sqrt(2.0) * sigma)); };
  SkinProfile profile;
  for (double d = -2.875; d < 5.5; d += 0.25) {
    const double outer = step(d - surface), inner = step(d - surface - thickness);
    profile.depth.push_back(d);
    profile.value.push_back(level * (outer - inner) + inner);
  }
  return profile;
}

/// Thickness [mm] and level over fat of the skin.
class SkinSlabFit : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(SkinSlabFit, FindsTheSlabThatTheProfileWasMadeOf) {
  const auto [thickness, level] = GetParam();
  for (const double surface : {-0.3, 0.0, 0.4}) {
    const SkinSlab fit = fit_skin_slab(profile_of(thickness, level, surface, 0.6), voxel_mm);
    // Tried in steps of 0.1 mm; the rest is what a usual thickness of 1.5 mm weighs.
    EXPECT_NEAR(fit.thickness, thickness, 0.2) << surface;
    EXPECT_NEAR(fit.surface, surface, 0.15);
    EXPECT_LE(fit.low, thickness);
    EXPECT_GE(fit.high, thickness);
    EXPECT_LT(fit.misfit, 0.005) << "an exact profile, but for the steps";
  }
}

INSTANTIATE_TEST_SUITE_P(ThicknessLevel, SkinSlabFit,
                         testing::Values(std::tuple{2.0, 2.0}, std::tuple{3.0, 2.0},
                                         std::tuple{2.0, 0.45}, std::tuple{3.0, 0.45},
                                         std::tuple{4.0, 1.6}));

TEST(SkinSlab, SaysMoreOfThickSkinThanOfThin) {
  const SkinSlab thin = fit_skin_slab(profile_of(1, 2, 0, 0.6), voxel_mm);
  const SkinSlab thick = fit_skin_slab(profile_of(3, 2, 0, 0.6), voxel_mm);
  EXPECT_LE(thin.low, 1);
  EXPECT_GE(thin.high, 1);
  EXPECT_GT(thin.high - thin.low, thick.high - thick.low);
}

TEST(SkinSlab, IsNotMeasuredWithoutAProfile) {
  SkinProfile few = profile_of(2, 2, 0, 0.6);
  few.depth.resize(11), few.value.resize(11);  // of 12 at least
  EXPECT_EQ(fit_skin_slab(few, voxel_mm).thickness, 0);
}

}  // namespace
}  // namespace mammotwin
