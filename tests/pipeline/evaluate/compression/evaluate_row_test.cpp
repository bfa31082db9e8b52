#include <gtest/gtest.h>

#include "pipeline/evaluate/compression/compression_row.h"
#include "pipeline/evaluate/compression/compression_summary.h"

namespace mammotwin {
namespace {

using nlohmann::json;

json good_sidecar() {
  return {{"status", "ok"},
          {"reasons", json::array()},
          {"quality",
           {{"thickness_mm", 55.05},
            {"mean_gap_mm", 0.15},
            {"max_penetration_mm", 0.4},
            {"J_within_half", 0.995},
            {"compressed_fraction", 0.5}}}};
}

json judged(const json& sidecar) {
  json row{{"name", "a"},      {"view", "cc"},     {"target_thickness_mm", 55}, {"hard", true},
           {"reached", false}, {"possible", true}, {"reason", nullptr}};
  judge_row(row, sidecar);
  return row;
}

json judged_with(const char* key, double value) {
  json sidecar = good_sidecar();
  sidecar["quality"][key] = value;
  return judged(sidecar);
}

TEST(CompressionRow, ReachedWhereAllFiguresHold) {
  const json row = judged(good_sidecar());
  EXPECT_TRUE(row["reached"]);
  EXPECT_TRUE(row["reason"].is_null());
  EXPECT_EQ(row["compressed_fraction"], 0.5);
}

TEST(CompressionRow, NotReachedWithAReasonWhereOneFigureDoesNotHold) {
  const std::pair<const char*, double> faults[] = {{"thickness_mm", 55.2},
                                                   {"mean_gap_mm", 0.26},
                                                   {"max_penetration_mm", 0.56},
                                                   {"J_within_half", 0.989}};
  for (const auto& [key, value] : faults) {
    const json row = judged_with(key, value);
    EXPECT_FALSE(row["reached"]) << key;
    EXPECT_TRUE(row["reason"].is_string()) << key;
  }
}

TEST(CompressionRow, NotConvergedIsNotReachedWhateverTheFigures) {
  json sidecar = good_sidecar();
  sidecar["status"] = "not_converged";
  sidecar["reasons"] = {"stopped at 60 mm"};
  const json row = judged(sidecar);
  EXPECT_FALSE(row["reached"]);
  EXPECT_EQ(row["reason"], "stopped at 60 mm");
}

TEST(CompressionRow, WithoutFiguresTheyAreNull) {
  const json row = judged({{"status", "refused"}, {"reasons", {"killed"}}});
  EXPECT_FALSE(row["reached"]);
  EXPECT_TRUE(row["min_J"].is_null());
  EXPECT_EQ(row["reason"], "killed");
}

TEST(CompressionSummary, NamesFailuresAndCountsThem) {
  json failed = judged_with("thickness_mm", 60);
  failed["name"] = "b";
  const std::string text = compression_summary({judged(good_sidecar()), failed});
  EXPECT_NE(text.find("1 of 2 reached"), std::string::npos) << text;
  EXPECT_NE(text.find("b "), std::string::npos) << text;
  EXPECT_NE(text.find("5.00 mm off"), std::string::npos) << text;
}

}  // namespace
}  // namespace mammotwin
