#include "segmentation/mri/series_look.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

/// A ball of fat at 100 with 4 mm of skin at 150 in noise of 5, in air.
TEST(SeriesLook, SeesSignalAndSuppression) {
  Volume<float> image({80, 80, 20}, Eigen::Vector3d::Constant(2), {0, 0, 0}, 0);
  unsigned state = 1;
  const auto noise = [&] {  // the sum of 12 uniform numbers is near a normal one
    double sum = -6;
    for (int n = 0; n < 12; ++n)
      state = 1664525U * state + 1013904223U, sum += state / 4294967296.0;
    return 5 * sum;
  };
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 80; ++i) {
        const double r = std::hypot(2.0 * i - 80, 2.0 * j - 80);
        const double signal = r < 56 ? 100 : r < 60 ? 150 : 0;
        image(i, j, k) = static_cast<float>(std::hypot(signal + noise(), noise()));
      }
  const auto look = look_at_series(image);
  ASSERT_TRUE(look);
  EXPECT_NEAR(look->signal_to_noise, 20, 3);
  EXPECT_GT(look->skin_over_fat, 1.3);
}

}  // namespace
}  // namespace mammotwin
