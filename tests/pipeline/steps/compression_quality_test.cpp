#include "pipeline/steps/compression_quality.h"

#include <gtest/gtest.h>

#include "pipeline/steps/quality_limits.h"

namespace mammotwin {
namespace {

CompressionReport good_report() {
  CompressionReport report;
  report.status = CompressionStatus::converged;
  report.thickness_mm = report.target_thickness_mm = 50;
  report.free_thickness_mm = 100;
  report.J_within_half = 1;
  return report;
}

TEST(CompressionQuality, EscapeBeyondItsLimitsIsToBeLookedAt) {
  const auto status = [&](double swing, double roll) {
    return judge_compression(good_report(), {swing, roll}, 0, false).status;
  };
  EXPECT_EQ(status(-limits::swing_mm + 0.1, limits::roll_deg - 0.1), Status::ok);
  EXPECT_EQ(status(-limits::swing_mm - 0.1, 0), Status::look);
  EXPECT_EQ(status(0, limits::roll_deg + 0.1), Status::look);
}

TEST(CompressionQuality, WhatIsNotQuiteReachedIsToBeLookedAtAndSaysByHowMuch) {
  const auto outcome = [](double CompressionReport::*figure, double value) {
    CompressionReport report = good_report();
    report.*figure = value;
    return judge_compression(report, {}, 0, false);
  };
  EXPECT_EQ(outcome(&CompressionReport::imbalance, 0.9e-3).status, Status::ok);
  const Outcome imbalanced = outcome(&CompressionReport::imbalance, 2.5e-3);
  EXPECT_EQ(imbalanced.status, Status::look);
  EXPECT_NE(imbalanced.reasons.at(0).find("by 0.25 %"), std::string::npos);
  EXPECT_EQ(outcome(&CompressionReport::thickness_mm, 50.2).status, Status::look);
  EXPECT_EQ(outcome(&CompressionReport::mean_gap_mm, 0.2).status, Status::ok);
  EXPECT_EQ(outcome(&CompressionReport::mean_gap_mm, 0.3).status, Status::look);
  EXPECT_EQ(outcome(&CompressionReport::max_penetration_mm, 0.6).status, Status::look);
  EXPECT_EQ(outcome(&CompressionReport::force_N, 190).status, Status::ok);
  const Outcome hard = outcome(&CompressionReport::force_N, 279);
  EXPECT_EQ(hard.status, Status::look);
  EXPECT_NE(hard.reasons.at(0).find("279 N"), std::string::npos);
  EXPECT_EQ(outcome(&CompressionReport::retained_fraction, 0.65).status, Status::ok);
  const Outcome slid = outcome(&CompressionReport::retained_fraction, 0.31);
  EXPECT_EQ(slid.status, Status::look);
  EXPECT_NE(slid.reasons.at(0).find("31 %"), std::string::npos);
  const Outcome drawn = outcome(&CompressionReport::drawn_times, 2);
  EXPECT_EQ(drawn.status, Status::look);
  EXPECT_NE(drawn.reasons.at(0).find("drawn forward 2 times as hard"), std::string::npos);
}

}  // namespace
}  // namespace mammotwin
