#include "segmentation/image/tube_response.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

/// The response at the middle of what is exp(-r^2 / (2 sigma^2)) high over `axes` axes: 1 a sheet,
/// 2 a tube, 3 a ball.
float at_middle(int axes, bool looked_at = true) {
  constexpr int n = 41, middle = n / 2;
  constexpr double spacing_mm = 0.8, sigma_mm = 2;
  std::vector<float> image(n * n * n);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        double squared = (i - middle) * (i - middle);
        if (axes > 1) squared += (j - middle) * (j - middle);
        if (axes > 2) squared += (k - middle) * (k - middle);
        squared *= spacing_mm * spacing_mm;
        image[(k * n + j) * n + i] =
            static_cast<float>(std::exp(-squared / (2 * sigma_mm * sigma_mm)));
      }
  const std::vector<std::uint8_t> where(image.size(), looked_at);
  const std::vector<float> response =
      tube_response({n, n, n}, {spacing_mm, spacing_mm, spacing_mm}, image, where, sigma_mm);
  return response[image.size() / 2];
}

/// A Gaussian smoothed by its own width is 1/2 as high over two axes, and curves by 1/2 / (2
/// sigma^2): times sigma^2, 1/4. ITK's recursive filter is good to a few per cent.
TEST(TubeResponse, IsAQuarterOfAMatchingTubesHeight) { EXPECT_NEAR(at_middle(2), 0.25, 0.01); }

TEST(TubeResponse, OfASheetAndABallIsNone) {
  EXPECT_NEAR(at_middle(1), 0, 0.01);
  EXPECT_NEAR(at_middle(3), 0, 0.01);
}

TEST(TubeResponse, IsLookedForWhereAskedOnly) { EXPECT_EQ(at_middle(2, false), 0); }

}  // namespace
}  // namespace mammotwin
