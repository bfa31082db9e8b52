#include "pipeline/synthesize/mean_fractions.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

/// Fat for x < 0, fibroglandular above, in voxels of 1 mm from -10 to 10 mm.
Volume<Fractions> halves() {
  Volume<Fractions> volume({21, 21, 21}, {1, 1, 1}, {-10, -10, -10});
  for (int k = 0; k < 21; ++k)
    for (int j = 0; j < 21; ++j)
      for (int i = 0; i < 21; ++i)
        volume(i, j, k) = i < 10 ? Fractions{1, 0, 0} : Fractions{0, 1, 0};
  return volume;
}

TEST(MeanFractions, AveragesOverTheCellAndNotTheVoxel) {
  const auto volume = halves();
  const MeanFractions mean(volume);
  // A cube of 4 mm around x = -0.5 holds the voxels -2, -1 (fat) and 0, 1 (fibroglandular).
  EXPECT_FLOAT_EQ(mean.at({-0.5, 0, 0}, 64).fat, 0.5f);
  EXPECT_FLOAT_EQ(mean.at({-0.5, 0, 0}, 64).fibroglandular, 0.5f);
  EXPECT_FLOAT_EQ(mean.at({-5, 0, 0}, 64).fat, 1);
}

TEST(MeanFractions, TakesTheNearestVoxelForASmallCell) {
  const auto volume = halves();
  EXPECT_FLOAT_EQ(MeanFractions(volume).at({0.4, 0.4, 0.4}, 1e-3).fibroglandular, 1);
}

TEST(MeanFractions, IgnoresWhatIsNotBreastAndIsFatBeyondIt) {
  auto volume = halves();
  for (int k = 0; k < 21; ++k)
    for (int j = 0; j < 21; ++j)
      for (int i = 10; i < 21; ++i) volume(i, j, k) = Fractions{};
  EXPECT_FLOAT_EQ(MeanFractions(volume).at({-0.5, 0, 0}, 64).fat, 1);
  EXPECT_FLOAT_EQ(MeanFractions(volume).at({50, 0, 0}, 64).fat, 1);
}

}  // namespace
}  // namespace mammotwin
