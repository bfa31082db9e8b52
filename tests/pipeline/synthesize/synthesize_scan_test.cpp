#include <gtest/gtest.h>

#include "pipeline/synthesize/scan.h"
#include "pipeline/synthesize/tissue_map.h"

namespace mammotwin {
namespace {

double level(const ScanOptions& options, Substance s) {
  return intensities(options)[static_cast<std::size_t>(s)];
}

/// The first `columns` voxels along x of one substance, the others of another.
TissueMap two_blocks(const Eigen::Vector3i& size, double spacing_mm, int columns, Substance first,
                     Substance other) {
  const auto spacing = Eigen::Vector3d::Constant(spacing_mm);
  TissueMap tissue{Volume<VoxelMixture>(size, spacing, {0, 0, 0}), 1};
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) ++tissue.mixtures(i, j, k)[i < columns ? first : other];
  return tissue;
}

TEST(Scan, OnlyContrastAgentLiftsALesionOverGland) {
  ScanOptions before;
  before.contrast = ScanContrast::not_suppressed;
  before.lesion_to_gland = 1.78;
  ScanOptions after = before;
  after.contrast_agent = true;
  EXPECT_LT(level(before, Substance::lesion), level(before, Substance::fibroglandular));
  EXPECT_DOUBLE_EQ(level(after, Substance::lesion), 1.78 * level(after, Substance::fibroglandular));
  // Relative enhancement, which `segment` outlines lesions in: over 1 in a lesion, little in gland.
  const auto uptake = [&](Substance s) { return level(after, s) / level(before, s) - 1; };
  EXPECT_GT(uptake(Substance::lesion), 1);
  EXPECT_LT(uptake(Substance::fibroglandular), 0.2);
  EXPECT_EQ(uptake(Substance::fat), 0);
}

TEST(Scan, MuscleAndOrgansAreAsBrightAsAsked) {
  ScanOptions options;
  const double usual = level(options, Substance::liver);
  options.muscle_to_fat = 0.6;
  EXPECT_EQ(level(options, Substance::muscle), 0.6);
  EXPECT_EQ(level(options, Substance::liver), usual);
  options.organs_to_fat = 2.2;
  EXPECT_EQ(level(options, Substance::heart), 2.2);
  EXPECT_EQ(level(options, Substance::liver), 2.2);
}

TEST(Scan, VesselsRunThroughFatAndAreBright) {
  const TissueMap tissue = two_blocks({60, 60, 60}, 1, 45, Substance::fat, Substance::muscle);
  const Coil coil({{0, 0, 0}}, 1e6, {0, 0, 0});
  ScanOptions options;
  options.noise = options.texture = options.blur_voxels = 0;
  options.muscle_to_fat = 1.5;
  options.vessels_to_fat = 4;
  const Scan image = scan(tissue, coil, options, 1, {0, 0, 0});
  int bright = 0, brightest = 0;
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i) {
        const int value = image.image(i, j, k);
        if (i >= 45)
          EXPECT_EQ(value, 1.5 * fat_grey) << "muscle";
        else
          bright += value > 2 * fat_grey, brightest = std::max(brightest, value);
      }
  EXPECT_EQ(brightest, 4 * fat_grey);
  // Two vessels for 162 ml of fat, of 3.14 x 0.9^2 x 40 mm^3 or more unless they end at muscle, and
  // of 3.14 x 2.5^2 x 140 at most.
  EXPECT_GT(bright, 50);
  EXPECT_LT(bright, 2 * 3.14 * 2.5 * 2.5 * 140);
}

/// A block of fat in the left half of the image; nothing else that could be seen.
TEST(Scan, GhostsLieBesideTheBody) {
  const TissueMap tissue = two_blocks({40, 10, 60}, 2, 15, Substance::fat, Substance::air);
  const Coil coil({{0, 0, 0}}, 1e6, {0, 0, 0});
  ScanOptions options;
  options.noise = options.texture = options.blur_voxels = 0;
  const auto brightest_at = [&](int column) {
    const Scan image = scan(tissue, coil, options, 1, {0, 0, 0});
    int brightest = 0;
    for (int k = 0; k < 60; ++k) brightest = std::max<int>(brightest, image.image(column, 5, k));
    return brightest;
  };
  EXPECT_EQ(brightest_at(25), 0);
  options.ghosts = 0.2;
  EXPECT_GT(brightest_at(25), 0.05 * fat_grey) << "18 columns, 0.45 of 40, beside column 7";
  EXPECT_LE(brightest_at(25), 0.2 * fat_grey + 1);
  EXPECT_EQ(brightest_at(16), 0) << "neither body nor its copy";
}

}  // namespace
}  // namespace mammotwin
