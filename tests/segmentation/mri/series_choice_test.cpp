#include "segmentation/mri/series_choice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

SeriesRow row(const char* number, std::size_t slices, double pixel_mm, double step_mm,
              std::optional<double> signal_to_noise) {
  SeriesRow r;
  r.number = number, r.slices = slices;
  r.voxel_mm = {pixel_mm, pixel_mm, step_mm};
  r.covers_mm = step_mm * (static_cast<double>(slices) - 1);
  if (signal_to_noise) r.look = SeriesLook{*signal_to_noise, 1.5};
  return r;
}

/// As in a study of which one series is left of each kind.
TEST(SeriesChoice, LeavesALateNoisySeriesHoweverFine) {
  std::vector<SeriesRow> rows{row("4", 58, 0.64, 3, 63.), row("9", 160, 1.02, 1.2, 15.),
                              row("24", 224, 0.9, 0.9, 6.)};
  EXPECT_EQ(choose_series_row(rows), 1U);
  EXPECT_TRUE(rows[1].is_read);
  EXPECT_NE(rows[0].reason.find("2.4 mm"), std::string::npos);
  EXPECT_NE(rows[2].reason.find("noisy"), std::string::npos);
}

TEST(SeriesChoice, TakesANoisySeriesWhereAllAreNoisy) {
  std::vector<SeriesRow> rows{row("9", 160, 1, 1.2, 6.), row("24", 224, 0.9, 0.9, 5.)};
  EXPECT_EQ(choose_series_row(rows), 1U) << "the finer one";
}

TEST(SeriesChoice, LeavesWhatCoversAPartOfTheBreast) {
  std::vector<SeriesRow> rows{row("1", 80, 0.5, 1, {}), row("2", 120, 1, 1.2, {})};
  EXPECT_EQ(choose_series_row(rows), 1U);
  EXPECT_NE(rows[0].reason.find("less than 100 mm"), std::string::npos);
}

/// A ball of fat at 100 with 4 mm of skin at 150 in noise of 5, in air.
TEST(SeriesChoice, SeesSignalAndSuppression) {
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
