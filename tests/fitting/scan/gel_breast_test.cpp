#include <gtest/gtest.h>

#include <iostream>

#include "pipeline/validation/known_skins.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

// What the project asks of a scan with 0.3 mm of noise, 1 % outliers and three holes.
TEST(GelBreast, IsFittedToAQuarterMillimetreOfItsTrueSkin) {
  const ScanAccuracy accuracy =
      gel_scan_accuracy(MAMMOTWIN_SOURCE_DIR "/sample_data/gel_breast/scan.ply");
  EXPECT_EQ(accuracy.holes, 3);
  EXPECT_NEAR(accuracy.noise_mm, 0.3, 0.1);
  EXPECT_LT(accuracy.outside_holes_mm, 0.25);
  EXPECT_LT(accuracy.all_mm, 0.4);
  std::cout << "RMS to the true skin: " << accuracy.outside_holes_mm << " mm outside the holes, "
            << accuracy.all_mm << " mm in all\n";
}

}  // namespace
}  // namespace mammotwin
