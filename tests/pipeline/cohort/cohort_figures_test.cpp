#include <gtest/gtest.h>

#include "pipeline/cohort/distribution.h"
#include "pipeline/cohort/histogram.h"
#include "pipeline/cohort/page.h"
#include "pipeline/cohort/tables.h"

namespace mammotwin {
namespace {

PatientSummary patient_with(const std::string& name, const nlohmann::json& quality) {
  StageResult result;
  result.product = "prone.vtu";
  result.stage = "fit";
  result.quality = quality;
  PatientSummary patient;
  patient.patient = name;
  patient.status = "ok";
  patient.results = {result};
  return patient;
}

std::vector<PatientSummary> cohort_of(const std::vector<double>& values) {
  std::vector<PatientSummary> cohort;
  for (std::size_t i = 0; i < values.size(); ++i)
    cohort.push_back(patient_with("p" + std::to_string(i), {{"rms_mm", values[i]}}));
  return cohort;
}

TEST(Figures, AreSortedAndNamedByPath) {
  const auto figures = figures_of("cc", {{"b", 1}, {"a", {{"x", 2}}}, {"none", nullptr}});
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[0].first, "cc.a.x");
  EXPECT_EQ(figures[1].first, "cc.b");
}

TEST(Distribution, QuartilesInterpolateBetweenNeighbours) {
  // Of 1, 2, 3, 4 the quartiles stand at positions 0.75, 1.5 and 2.25.
  const auto d = distributions_of(cohort_of({4, 2, 3, 1})).front();
  EXPECT_DOUBLE_EQ(d.first_quartile, 1.75);
  EXPECT_DOUBLE_EQ(d.median, 2.5);
  EXPECT_DOUBLE_EQ(d.third_quartile, 3.25);
}

TEST(Distribution, OutliersLieBeyondOneAndAHalfQuartileRanges) {
  // Quartiles of 1..6, x are 2.5 and 5.5 for x >= 6, so the fence is 5.5 + 1.5 * 3 = 10.
  EXPECT_TRUE(distributions_of(cohort_of({1, 2, 3, 4, 5, 6, 10})).front().outliers().empty());
  const auto found = distributions_of(cohort_of({1, 2, 3, 4, 5, 6, 10.1})).front().outliers();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front().patient, "p6");
}

TEST(Distribution, IgnoresTextAndKeepsTruthValuesOut) {
  const std::vector<PatientSummary> cohort{patient_with("p", {{"side", "left"}, {"flag", true}})};
  EXPECT_TRUE(distributions_of(cohort).empty());
}

TEST(Histogram, SaysInWordsWhatItShows) {
  const auto d = distributions_of(cohort_of({1, 2, 3, 4, 5})).front();
  const std::string svg = histogram_svg(d);
  EXPECT_NE(svg.find("role=\"img\""), std::string::npos);
  EXPECT_NE(svg.find("5 patients from 1 to 5, median 3, middle half from 2 to 4, 0 outliers"),
            std::string::npos);
  EXPECT_EQ(unit_of("prone.rms_mm"), "mm");
  EXPECT_EQ(unit_of("cc.steps"), "");
}

TEST(Tables, LeaveEmptyWhatAPatientLacks) {
  const Table table =
      cohort_table({patient_with("a", {{"x", 1}}), patient_with("b", {{"y", 0.5}})});
  EXPECT_EQ(table.columns, (std::vector<std::string>{"patient", "status", "stage", "reason",
                                                     "prone.x", "prone.y"}));
  EXPECT_EQ(table.rows[0].back(), "");
  EXPECT_EQ(table.rows[1].back(), "0.5");
}

TEST(Tables, KeepAReasonOnOneLine) {
  PatientSummary patient = patient_with("a", {});
  patient.reasons = {"first\tline\nsecond"};
  EXPECT_EQ(cohort_table({patient}).text(),
            "patient\tstatus\tstage\treason\na\tok\t\tfirst line second\n");
}

TEST(RunAgain, NamesNoFolder) {
  EXPECT_EQ(RunAgain{"make"}.command("042"),
            R"(make patient P=042 DATA="$DATA" RESULTS="$RESULTS")");
}

// 160 patients between 1 and 5, and 40 at 1000: the fence stands near 10, and all 40 lie outside.
TEST(CohortPage, NamesTheThirtyPatientsThatItPromises) {
  std::vector<double> values;
  for (int n = 0; n < 160; ++n) values.push_back(1 + n % 5);
  values.resize(200, 1000);
  const std::string page = cohort_page(cohort_of(values), {});
  const std::size_t first = page.find("id=\"outliers\""), last = page.find("id=\"distributions\"");
  ASSERT_NE(first, std::string::npos);
  int rows = 0;
  for (std::size_t at = page.find("<tr><th scope=\"row\">", first); at < last; ++rows)
    at = page.find("<tr><th scope=\"row\">", at + 1);
  EXPECT_EQ(rows, 30);
}

}  // namespace
}  // namespace mammotwin
