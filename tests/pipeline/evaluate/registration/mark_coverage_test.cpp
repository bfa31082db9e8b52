#include "pipeline/evaluate/registration/mark_coverage.h"

#include <gtest/gtest.h>

#include <random>

namespace mammotwin {
namespace {

/// Marks off by a normal law of standard deviations 2 and 1 mm, said to be `stated` times that.
std::vector<JudgedMark> marks(int count, double stated) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<JudgedMark> all;
  for (int n = 0; n < count; ++n) {
    JudgedMark mark{n % 2 == 0, {2 * normal(random), normal(random)}, {}};
    mark.covariance = stated * stated * Eigen::Vector2d(4, 1).asDiagonal().toDenseMatrix();
    all.push_back(mark);
  }
  return all;
}

// A normal law's ellipse of probability p has semi-axes sqrt(-2 ln(1 - p)) sd.
TEST(MarkCoverage, AnHonestEllipseHoldsWhatItSays) {
  const auto row = coverage_of(marks(4000, 1));
  EXPECT_NEAR(row["inside_50"].get<double>(), 0.5,
              0.032);  // four standard deviations of 4000 draws
  EXPECT_NEAR(row["inside_90"].get<double>(), 0.9, 0.019);
  EXPECT_NEAR(row["major_50_mm"].get<double>(), 2 * std::sqrt(2 * std::log(2.0)), 1e-9);
  EXPECT_NEAR(row["major_90_mm"].get<double>(), 2 * std::sqrt(2 * std::log(10.0)), 1e-9);
}

// Twice as wide: 1 - exp(-4 ln 2) and 1 - exp(-4 ln 10).
TEST(MarkCoverage, AnEllipseThatIsTooLargeHoldsMore) {
  const auto row = coverage_of(marks(4000, 2));
  EXPECT_NEAR(row["inside_50"].get<double>(), 0.9375, 0.016);
  EXPECT_GT(row["inside_90"].get<double>(), 0.998);
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
