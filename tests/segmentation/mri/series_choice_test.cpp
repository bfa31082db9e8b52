#include "segmentation/mri/series_choice.h"

#include <gtest/gtest.h>

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

TEST(SeriesChoice, TakesThePhaseBeforeOfADynamicStudyOnly) {
  std::vector<SeriesRow> rows{row("7", 160, 1, 1.2, 15.), row("8", 160, 1, 1.2, 15.),
                              row("9", 160, 1, 1.2, 15.)};
  rows[1].seconds = 300, rows[2].seconds = 400;
  EXPECT_EQ(choose_series_row(rows), 1U);
  EXPECT_FALSE(rows[0].is_before_agent) << "two series that happen to serve equally";
  for (int n = 0; n < 3; ++n) rows[n].phase = n + 1, rows[n].is_read = false;
  EXPECT_EQ(choose_series_row(rows), 1U);
  EXPECT_TRUE(rows[0].is_before_agent);
  EXPECT_FALSE(rows[2].is_before_agent);
}

TEST(SeriesChoice, ComparesTheWallWithThatOfASeriesOfTheOtherContrast) {
  std::vector<SeriesRow> rows{row("4", 58, 0.64, 3, 63.), row("8", 160, 1, 1.2, 15.),
                              row("9", 160, 1, 1.2, 15.)};
  rows[0].look->skin_over_fat = 0.4;
  rows[1].seconds = 100, rows[2].seconds = 200;
  EXPECT_EQ(choose_series_row(rows), 2U);
  EXPECT_EQ(choose_compared_row(rows, 2), 0U);
  EXPECT_TRUE(rows[0].is_compared);
}

TEST(SeriesChoice, ComparesTheWallWithTheNearestInTimeWhereAllAreAlike) {
  std::vector<SeriesRow> rows{row("7", 160, 1, 1.2, 15.), row("8", 160, 1, 1.2, 15.),
                              row("9", 160, 1, 1.2, 15.)};
  rows[1].seconds = 300, rows[2].seconds = 400;
  EXPECT_EQ(choose_compared_row(rows, 2), 1U);
}

TEST(SeriesChoice, ComparesWithNothingNoisyComputedOrOfAPart) {
  std::vector<SeriesRow> rows{row("9", 160, 1, 1.2, 15.),  row("24", 160, 1, 1.2, 6.),
                              row("10", 160, 1, 1.2, 15.), row("2", 60, 1, 1.2, 15.),
                              row("3", 40, 1, 5, 15.),     row("1", 160, 1, 1.2, {})};
  rows[2].is_computed = true;
  EXPECT_FALSE(choose_compared_row(rows, 0));
}

}  // namespace
}  // namespace mammotwin
