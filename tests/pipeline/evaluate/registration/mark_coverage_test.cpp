#include "pipeline/evaluate/registration/mark_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "registration/search/search_ellipse.h"

namespace mammotwin {
namespace {

/// Marks off by Student's law with ten degrees of freedom (search_ellipse.h) of standard deviations
/// 2 and 1 mm, said to be `stated` times that.
std::vector<JudgedMark> marks(int count, double stated) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::chi_squared_distribution<double> chi_squared(10);
  std::vector<JudgedMark> all;
  for (int n = 0; n < count; ++n) {
    const double root = std::sqrt(chi_squared(random) / 8);
    JudgedMark mark{n % 2 == 0, {2 * normal(random) / root, normal(random) / root}, {}};
    mark.covariance = stated * stated * Eigen::Vector2d(4, 1).asDiagonal().toDenseMatrix();
    all.push_back(mark);
  }
  return all;
}

TEST(MarkCoverage, AnHonestEllipseHoldsWhatItSays) {
  const auto row = coverage_of(marks(4000, 1));
  EXPECT_NEAR(row["inside_50"].get<double>(), 0.5,
              0.032);  // four standard deviations of 4000 draws
  EXPECT_NEAR(row["inside_90"].get<double>(), 0.9, 0.019);
  EXPECT_NEAR(row["major_50_mm"].get<double>(), 2 * semi_axis_in_sd(0.5), 1e-9);
  EXPECT_NEAR(row["major_90_mm"].get<double>(), 2 * semi_axis_in_sd(0.9), 1e-9);
}

// Twice as wide: 1 - (1 + 4 a^2 / 8)^-5, a being 1.09 and 2.16.
TEST(MarkCoverage, AnEllipseThatIsTooLargeHoldsMore) {
  const auto row = coverage_of(marks(4000, 2));
  EXPECT_NEAR(row["inside_50"].get<double>(), 0.903, 0.019);
  EXPECT_GT(row["inside_90"].get<double>(), 0.99);
}

TEST(MarkCoverage, GoesThroughJson) {
  const JudgedMark mark = marks(1, 1.5).front();
  const JudgedMark back = mark_of(mark_json(mark));
  EXPECT_EQ(back.lesion, mark.lesion);
  EXPECT_EQ(back.off, mark.off);
  EXPECT_EQ(back.covariance, mark.covariance);
}

TEST(MarkCoverage, SaysNothingOfNoMarks) {
  EXPECT_TRUE(coverage_of({})["inside_50"].is_null());
  EXPECT_EQ(coverage_summary({{}, {}}), "");
  EXPECT_NE(coverage_summary({marks(10, 1), marks(10, 1)}).find("20 marks in 2 patients"),
            std::string::npos);
}

}  // namespace
}  // namespace mammotwin
