// What the page says of its sliders is what docs/measured says.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "registration/search/what_if.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

TEST(WhatIfFigures, ArePublishedAsMeasured) {
  std::ifstream file(MAMMOTWIN_SOURCE_DIR "/docs/measured/data/what_if.json");
  const nlohmann::json measured = nlohmann::json::parse(file);
  std::vector<double> median, p95;  // of each view
  for (const nlohmann::json& row : measured["cases"]) {
    if (row["model"] != "slopes") continue;
    median.push_back(row["tissue_median_mm"]);
    p95.push_back(row["tissue_p95_mm"]);
  }
  ASSERT_EQ(median.size(), static_cast<std::size_t>(kWhatIfViews));
  const auto expect_published = [](const WhatIfError& said, const std::vector<double>& found) {
    constexpr double kRounding_mm = 0.05;
    EXPECT_NEAR(said.best_mm, *std::min_element(found.begin(), found.end()), kRounding_mm);
    EXPECT_NEAR(said.worst_mm, *std::max_element(found.begin(), found.end()), kRounding_mm);
  };
  expect_published(kWhatIfMedian, median);
  expect_published(kWhatIfP95, p95);
}

}  // namespace
}  // namespace mammotwin
