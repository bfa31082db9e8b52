#include "pipeline/evaluate/registration/ellipse_rows.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pipeline/evaluate/registration/mark_coverage.h"

namespace mammotwin {
namespace {

using nlohmann::json;

/// A patient whose marks all are `off_mm` deeper than said, with ellipses of `sd_mm`.
json patient(double off_mm, double sd_mm, double baseline_mm, const char* end) {
  json row{{"tre_mlo_mm", nullptr}, {"tre_3d_mm", nullptr}, {"tre_cc_mm", off_mm}};
  row["baseline_tre_cc_mm"] = baseline_mm;
  row["errors"] = {{"tre_cc_mm", {off_mm, off_mm}}};
  row["search"] = {{"cc", {{"end", end}}}};
  for (const bool lesion : {true, false})
    row["marks"].push_back(
        mark_json({lesion, {off_mm, 0}, sd_mm * sd_mm * Eigen::Matrix2d::Identity(), lesion}));
  return row;
}

json row_of(const json& rows, const std::string& name) {
  for (const json& row : rows)
    if (row.at("name") == name) return row;
  return {};
}

const json kThreePatients = ellipse_rows(
    {patient(3, 1, 20, "ok"), patient(30, 9, 10, "ok"), patient(25, 20, 30, "no registration")});

TEST(EllipseRows, ThirdsAreBySize) {
  EXPECT_EQ(row_of(kThreePatients, "all marks")["marks"], 6);
  EXPECT_EQ(row_of(kThreePatients, "lesions")["marks"], 3);
  EXPECT_EQ(row_of(kThreePatients, "in the image")["marks"], 3);  // the lesions are
  EXPECT_EQ(row_of(kThreePatients, "beside the image")["marks"], 3);
  EXPECT_EQ(row_of(kThreePatients, "smallest third")["inside_90"], 0);  // 3 mm, of 2.1
  EXPECT_EQ(row_of(kThreePatients, "middle third")["inside_90"], 0);    // 30 mm, of 19
  EXPECT_EQ(row_of(kThreePatients, "largest third")["inside_90"], 1);   // 25 mm, of 43
  EXPECT_EQ(row_of(kThreePatients, "largest third")["inside_50"], 0);   // of 24
  EXPECT_EQ(row_of(kThreePatients, "middle third")["median_error_mm"], 30);
}

TEST(EllipseRows, PatientsAreHeldAgainstTheBaselineAndWhatWasSaid) {
  const json cc = row_of(kThreePatients, "CC");
  EXPECT_EQ(cc["nearer_than_baseline"], "2 of 3");
  EXPECT_EQ(cc["over_20_mm_said"], "1 of 2");
  EXPECT_EQ(cc["p95_error_mm"], 30);
  EXPECT_EQ(row_of(kThreePatients, "MLO")["nearer_than_baseline"], "0 of 0");
  EXPECT_TRUE(row_of(kThreePatients, "MLO")["median_error_mm"].is_null());
}

}  // namespace
}  // namespace mammotwin
