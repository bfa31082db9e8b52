#include "pipeline/evaluate/measured/measured_page.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "pipeline/frame/toml_file.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

MeasuredPage small_page() {
  return {"small",
          "Small",
          "Three breasts.",
          "make small",
          "small.json",
          {"name", "side"},
          std::nullopt,
          true,
          true,
          {{"rms_mm", "RMS [mm]", 2, false, 0.5},
           {"volume.share", "share", 1, true, 0.9},
           {"ok", "usable", 2, false, std::nullopt}}};
}

const json kRows = {
    {"cases",
     {{{"name", "a"},
       {"side", "left"},
       {"rms_mm", 0.1},
       {"ok", true},
       {"volume", {{"share", 0.8}}}},
      {{"name", "b"}, {"rms_mm", 0.75}, {"ok", false}, {"volume", nullptr}},
      {{"name", "c"}, {"rms_mm", 0.2}, {"ok", true}, {"volume", {{"share", 1.0}}}}}}};

// Medians 0.2 of (0.1, 0.2, 0.75) and 0.9 of (0.8, 1.0); worst 0.75 (above 0.5) and 0.8 (below
// 0.9).
TEST(MeasuredPage, SummarisesByMedianAndWorst) {
  EXPECT_NE(measured_markdown(small_page(), kRows)
                .find("| all | 3 | 0.20, **0.75** | 0.9, **0.8** | 2 of 3 |"),
            std::string::npos);
}

TEST(MeasuredPage, HasALineForEachCaseAndLeavesOutWhatIsNotKnown) {
  const std::string text = measured_markdown(small_page(), kRows);
  EXPECT_NE(text.find("| a left | 0.10 | **0.8** | yes |"), std::string::npos) << text;
  EXPECT_NE(text.find("| b | **0.75** |  | **no** |"), std::string::npos) << text;
}

TEST(MeasuredPage, TheWorstOfSignedNumbersIsTheLargestInSize) {
  json rows = kRows;
  rows["cases"][1]["rms_mm"] = -0.75;
  const std::string text = measured_markdown(small_page(), rows);
  EXPECT_NE(text.find("| all | 3 | 0.10, **-0.75** |"), std::string::npos) << text;
  EXPECT_NE(text.find("| b | **-0.75** |"), std::string::npos) << text;
}

TEST(MeasuredPage, MayBeItsCasesAlone) {
  MeasuredPage page = small_page();
  page.summary = false;
  const std::string text = measured_markdown(page, kRows);
  EXPECT_EQ(text.find("| all |"), std::string::npos) << text;
  EXPECT_EQ(text.find("median"), std::string::npos) << text;
  EXPECT_NE(text.find("| a left | 0.10 |"), std::string::npos) << text;
}

TEST(MeasuredPage, GroupsTheSummary) {
  MeasuredPage page = small_page();
  page.group_by = "ok";
  const std::string text = measured_markdown(page, kRows);
  EXPECT_NE(text.find("| true | 2 | 0.15, 0.20 |"), std::string::npos) << text;
  EXPECT_NE(text.find("| false | 1 | **0.75**, **0.75** |"), std::string::npos) << text;
}

TEST(MeasuredPage, RefusesAnEvaluationWithoutCases) {
  EXPECT_THROW(measured_markdown(small_page(), json{{"cases", json::array()}}), std::runtime_error);
  EXPECT_THROW(measured_markdown(small_page(), json::array()), std::runtime_error);
}

TEST(MeasuredPage, NamesAnUnknownKeyOfItsDescription) {
  const json tables = {{{"name", "x"},
                        {"title", "X"},
                        {"about", ""},
                        {"command", "make x"},
                        {"colums", json::array()}}};
  try {
    measured_pages(tables);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("unknown key \"colums\""), std::string::npos);
  }
}

// No figure of docs/measured is typed: each page is what its data says.
TEST(MeasuredPage, PagesOfTheDocumentationAreWhatTheirDataSays) {
  const fs::path folder = fs::path(MAMMOTWIN_SOURCE_DIR) / "docs" / "measured";
  int pages = 0;
  for (const auto& [key, value] : read_toml(folder / "pages.toml")) {
    if (key != "page") continue;
    for (const MeasuredPage& page : measured_pages(value)) {
      std::ifstream data(folder / "data" / (page.name + ".json"));
      if (!data) continue;  // not measured yet
      std::ifstream in(folder / (page.name + ".md"));
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      EXPECT_EQ(text, measured_markdown(page, json::parse(data))) << "make measured";
      ++pages;
    }
  }
  if (pages == 0) GTEST_SKIP() << "no page has figures yet";
}

}  // namespace
}  // namespace mammotwin
