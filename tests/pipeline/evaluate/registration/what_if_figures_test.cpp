// What the page says of its sliders is what docs/measured says.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "registration/search/what_if.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

TEST(WhatIfFigures, ArePublishedAsMeasured) {
  std::ifstream file(MAMMOTWIN_SOURCE_DIR "/docs/measured/data/what_if.json");
  const nlohmann::json measured = nlohmann::json::parse(file);
  double median = 0, p95 = 0;  // of the breast that is worst
  for (const nlohmann::json& row : measured["cases"]) {
    if (row["model"] != "quadratic") continue;
    median = std::max(median, row["tissue_median_mm"].get<double>());
    p95 = std::max(p95, row["tissue_p95_mm"].get<double>());
  }
  constexpr double kRounding_mm = 0.1;  // upwards
  EXPECT_GE(kWhatIfMedian_mm, median);
  EXPECT_LT(kWhatIfMedian_mm, median + kRounding_mm);
  EXPECT_GE(kWhatIfP95_mm, p95);
  EXPECT_LT(kWhatIfP95_mm, p95 + kRounding_mm);
}

}  // namespace
}  // namespace mammotwin
