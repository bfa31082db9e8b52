#include "pipeline/steps/compression_quality.h"

#include <gtest/gtest.h>

#include "pipeline/steps/quality_limits.h"

namespace mammotwin {
namespace {

TEST(CompressionQuality, SidewaysEscapeBeyondItsLimitsIsToBeLookedAt) {
  CompressionReport report;
  report.status = CompressionStatus::converged;
  report.thickness_mm = report.target_thickness_mm = 50;
  report.free_thickness_mm = 100;
  report.J_within_half = 1;
  const auto status = [&](double swing, double roll) {
    return judge_compression(report, {swing, roll}, 0, false).status;
  };
  EXPECT_EQ(status(-limits::swing_mm + 0.1, limits::roll_deg - 0.1), Status::ok);
  EXPECT_EQ(status(-limits::swing_mm - 0.1, 0), Status::look);
  EXPECT_EQ(status(0, limits::roll_deg + 0.1), Status::look);
}

}  // namespace
}  // namespace mammotwin
