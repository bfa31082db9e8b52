#include "segmentation/image/otsu.h"

#include <gtest/gtest.h>

#include <random>

namespace mammotwin {
namespace {

TEST(Otsu, OfTwoSharpValuesLiesBetweenThem) {
  std::vector<float> values(300, 1.0F);
  values.insert(values.end(), 100, 3.0F);
  const double threshold = otsu_threshold(values, 3);
  EXPECT_GT(threshold, 1);
  EXPECT_LT(threshold, 3);
}

/// Two normal distributions of one width and size: the threshold is their middle, by symmetry.
TEST(Otsu, OfTwoEqualNormalsIsTheirMiddle) {
  std::mt19937 random(2);
  std::normal_distribution<float> noise(0, 0.2F);
  std::vector<float> values;
  for (int n = 0; n < 20000; ++n)
    values.push_back(1 + noise(random)), values.push_back(2 + noise(random));
  // A bin is 3 / 255; the mean of 20000 values is good to 0.2 / sqrt(20000) = 0.0014.
  EXPECT_NEAR(otsu_threshold(values, 3), 1.5, 2 * 3.0 / 255);
}

TEST(Otsu, OfWhatIsBrighterThanTheTopCountsAsTheTop) {
  std::vector<float> values(300, 1.0F);
  values.insert(values.end(), 100, 3.0F);
  const double before = otsu_threshold(values, 3);
  for (float& value : values)
    if (value > 2) value = 1000;
  EXPECT_EQ(otsu_threshold(values, 3), before);
  EXPECT_EQ(otsu_threshold({}, 3), 0);
}

}  // namespace
}  // namespace mammotwin
