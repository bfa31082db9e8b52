#include "pipeline/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "pipeline/frame/sidecar.h"
#include "pipeline/report/answer_data.h"
#include "pipeline/report/figures/overview_picture.h"
#include "pipeline/report/page_data.h"
#include "pipeline/report/page_template.h"
#include "tests/file_text.h"
#include "tests/pipeline/report/report_fake_results.h"
#include "tests/scratch_file.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + 1)) ++n;
  return n;
}

const std::string& whole_page() {
  static const std::string page = render_page(page_data(fake_results(Side::left), "0.1.0"));
  return page;
}

TEST(ReportPage, ShowsEveryFigureOfAFinishedChain) {
  // Two lesions: an MRI figure each, two cuts each; two detectors; prone, unloaded and two views;
  // fit; force; convergence; frames. (What planes.js makes is not in the text as "<figure".)
  EXPECT_EQ(count(whole_page(), "<figure"), 2u + 4u + 2u + 4u + 1u + 1u + 1u + 1u);
  EXPECT_NE(whole_page().find("Checks passed"), std::string::npos);
  EXPECT_NE(whole_page().find("not a medical device"), std::string::npos);
}

TEST(ReportPage, TellsInTheOrderInWhichItIsRead) {
  std::size_t last = 0;
  for (const char* id :
       {"verdict", "lesions", "mri", "breast", "fit", "course", "quality", "provenance", "files"}) {
    const std::size_t at = whole_page().find("<section id=\"" + std::string(id) + "\"");
    ASSERT_NE(at, std::string::npos) << id;
    EXPECT_GT(at, last) << id;
    last = at;
  }
  EXPECT_EQ(count(whole_page(), "<a href=\"cc.vtu\">"),
            1u);  // files that a person opens, and no others
  EXPECT_EQ(whole_page().find("href=\"cc.vtu.json\""), std::string::npos);
}

TEST(ReportPage, ListsTheSeriesAndWhyOneWasRead) {
  EXPECT_EQ(whole_page().find("Series of the MRI"), std::string::npos) << "none was chosen";
  PatientResults chosen = fake_results(Side::left);
  chosen.stages.front().sidecar["quality"]["series"] = {{{"series", "9"},
                                                         {"slices", 160},
                                                         {"voxel_mm", {1.02, 1.02, 1.2}},
                                                         {"covers_mm", 190.8},
                                                         {"seconds_after_first", 95},
                                                         {"phase", nullptr},
                                                         {"signal_to_noise", 15.2},
                                                         {"skin_over_fat", nullptr},
                                                         {"read", true},
                                                         {"reason", "the one that serves"}}};
  const std::string page = render_page(page_data(chosen, "0.1.0"));
  EXPECT_NE(page.find("Series of the MRI"), std::string::npos);
  EXPECT_NE(page.find("1.02 × 1.02 × 1.20"), std::string::npos);
  EXPECT_NE(page.find("read: the one that serves"), std::string::npos);
}

TEST(ReportPage, SaysWhatWasAssumedOfAThickness) {
  EXPECT_EQ(whole_page().find("nobody says how thick"), std::string::npos);
  PatientResults assumed = fake_results(Side::left);
  for (StageRecord& record : assumed.stages)
    if (record.product == "cc.vtu") {
      record.sidecar["quality"]["thickness_assumed"] = true;
      record.sidecar["quality"]["stopped_by_force"] = true;
      record.sidecar["quality"]["thickness_mm"] = 55.7;
      record.sidecar["quality"]["force_N"] = 143.7;
    }
  const std::string page = render_page(page_data(assumed, "0.1.0"));
  EXPECT_EQ(count(page, "Pressed to 56 mm, where the paddle presses with 144 N: nobody says"), 2u)
      << "once for each lesion";
}

// 11 to 16 iterations in six steps, 81 in all, and 20 at the end of each view.
TEST(ReportPage, DrawsConvergence) {
  EXPECT_NE(whole_page().find("CC: 101 in all. MLO: 101 in all."), std::string::npos);
}

TEST(ReportPage, SaysHowTheBreastHung) {
  EXPECT_NE(whole_page().find("Imaged prone, the breast sags by up to 7.2 mm"), std::string::npos);
  PatientResults off = fake_results(Side::left);
  off.views.clear();
  for (StageRecord& stage : off.stages)
    if (stage.product == "unloaded.vtu") stage.sidecar["quality"]["gravity"] = "none";
  EXPECT_NE(render_page(page_data(off, "0.1.0")).find("Gravity was not taken off"),
            std::string::npos);
}

TEST(ReportPage, GivesEveryPictureWordsAndReachesForNothingOutside) {
  const std::string& page = whole_page();
  EXPECT_EQ(count(page, "<img "), count(page, "alt=\""));
  // Layers over a picture are told of in its words.
  EXPECT_EQ(count(page, "alt=\"\""), count(page, "<img class=\"layer "));
  for (const char* outside : {"src=\"http", "href=\"http", "@import", "src=\"//"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);  // three.js can fetch; it may not
  EXPECT_LT(page.size(), 20u << 20);                              // the page's limit
}

// The made-up lesion 1 lies 18 mm lateral of, 57 mm behind and 14 mm above the nipple: 61 mm away,
// and at atan2(18, 14) = 52 degrees, which is 2 o'clock. The muscle begins 87 mm behind the nipple.
TEST(ReportPage, SaysWhereFirstInTheWordsOfAReport) {
  const std::string& page = whole_page();
  const std::size_t words = page.find(
      "left breast, upper outer, 2 o&apos;clock, middle third, 61 mm from the nipple, 0.9 ml.");
  ASSERT_NE(words, std::string::npos);
  EXPECT_LT(words, page.find("<img "));
  EXPECT_LT(words, page.find("Detector u, v"));
}

TEST(ReportPage, SaysBesideEveryEllipseHowFarItHasBeenChecked) {
  PatientResults results = fake_results(Side::left);
  for (LesionRow& row : results.rows)
    if (row.view != "mri") {
      row.ellipse_major_mm = 33.4, row.ellipse_minor_mm = 11.8, row.ellipse_angle_deg = 2;
      row.picture_ellipse_major_mm = 13.8, row.picture_ellipse_minor_mm = 9.7;
      row.picture_ellipse_angle_deg = 45;
    }
  const std::string page = render_page(page_data(results, "0.1.0"));
  // Two cards and the views' note.
  EXPECT_EQ(count(page, kAccuracyWords), 3u);
  EXPECT_EQ(count(page,
                  "Search within 14 × 10 mm of it in the simulated view</b>; no mammogram was "
                  "registered, so on a real one within 33 × 12 mm."),
            4u);
  EXPECT_EQ(count(whole_page(), kAccuracyWords), 3u);  // and where there is no ellipse
}

TEST(ReportPage, SaysInTheAnswerThatAMammogramIsNotRegisteredOrInDoubt) {
  PatientResults results = fake_results(Side::left);
  EXPECT_EQ(whole_page().find("Not registered with this mammogram"), std::string::npos);
  for (StageRecord& stage : results.stages)
    if (stage.product == "lesions.csv")
      stage.sidecar["quality"]["search"] = {
          {"cc", {{"end", "look"}, {"reasons", {"cc: by outline alone; nothing else says so"}}}},
          {"mlo",
           {{"end", "no registration"},
            {"reasons",
             {"mlo: registered by outline alone",
              "mlo: no registration: the patterns correlate by 0.2 only"}}}}};
  const std::string page = render_page(page_data(results, "0.1.0"));
  EXPECT_EQ(count(page, "Not registered with this mammogram: the patterns correlate by 0.2 only."),
            2u)
      << "once for each lesion, of MLO alone";
  EXPECT_EQ(count(page, "In doubt: by outline alone; nothing else says so."), 2u);
}

TEST(ReportPage, DoubtsASupinePlaceThatNoBreastReaches) {
  PatientResults results = fake_results(Side::left);
  for (LesionRow& row : results.rows)
    if (row.view == "mri") row.supine_depth_mm = 20, row.supine_from_nipple_mm = 50;
  const auto page_of = [&](double move_mm) {
    for (StageRecord& stage : results.stages)
      if (stage.product == "unloaded.vtu") stage.sidecar["quality"]["supine_move_max_mm"] = move_mm;
    return render_page(page_data(results, "0.1.0"));
  };
  EXPECT_EQ(page_of(190).find("not to be believed"), std::string::npos);
  const std::string page = page_of(247);
  EXPECT_EQ(count(page, "not to be believed"), 2u);
  EXPECT_EQ(count(page, "the model goes 247 mm from prone to supine"), 2u);
}

TEST(ReportPage, SupineWordsAreOfTheTable) {
  std::ifstream file(MAMMOTWIN_SOURCE_DIR "/docs/measured/data/gravity.json");
  const nlohmann::json measured = nlohmann::json::parse(file);
  std::vector<double> ways;
  for (const nlohmann::json& row : measured["cases"])
    if (row["nipple_mm"].is_number()) ways.push_back(row["nipple_mm"]);
  ASSERT_GE(ways.size(), 20u);
  std::sort(ways.begin(), ways.end());
  const double median = (ways[(ways.size() - 1) / 2] + ways[ways.size() / 2]) / 2;
  const std::string said =
      "the default tissue's by " + std::to_string(std::lround(median)) + " and";
  EXPECT_NE(std::string(kSupineWords).find(said), std::string::npos) << said;
}

TEST(ReportPage, SaysTheSameTwice) {
  EXPECT_EQ(render_page(page_data(fake_results(Side::left), "0.1.0")), whole_page());
}

TEST(ReportPage, EscapesWhatComesFromOutside) {
  PatientResults results = fake_results(Side::right);
  results.views.clear();
  results.rows[0].lesion = "<script>alert(1)</script>";
  results.segmentation->lesions[0].id = "</script><b>";
  const std::string page = render_page(page_data(results, "0.1.0"));
  EXPECT_EQ(page.find("<script>alert(1)"), std::string::npos);
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
}

TEST(ReportPage, IsWrittenWhenTheFirstStageRefused) {
  const fs::path folder = scratch_file("refused");
  fs::create_directories(folder);
  const fs::path product = folder / "segmentation.seg.nrrd";
  const nlohmann::json none = nlohmann::json::object();
  const Outcome refused{Status::refused, {"the 100.8 mm hole between slices 40 and 41"}, none};
  write_sidecar(product, make_sidecar(product, make_provenance("segment", none, {}, product),
                                      refused, {}, {}));
  write_report(read_patient_results(folder), folder / "report.html", "0.1.0");
  const std::string page = text_of(folder / "report.html");
  EXPECT_NE(page.find("Refused"), std::string::npos);
  EXPECT_NE(page.find("the 100.8 mm hole between slices 40 and 41"), std::string::npos);
  EXPECT_EQ(page.find("id=\"viewer\""), std::string::npos);
  EXPECT_NE(page.find("<h1>Patient refused</h1>"),
            std::string::npos);  // of a side nothing is known
}

TEST(ReportPage, NotesAProductThatCannotBeRead) {
  const fs::path folder = scratch_file("broken");
  fs::create_directories(folder);
  write_text(folder / "prone.vtu", "not a mesh");
  const PatientResults results = read_patient_results(folder);
  ASSERT_EQ(results.notes.size(), 1u);
  EXPECT_NE(results.notes[0].find("prone.vtu could not be read"), std::string::npos);
  EXPECT_THROW(read_patient_results(scratch_file("absent")), std::runtime_error);
}

TEST(ReportPage, StopsAtTheViewThatDidNotConverge) {
  PatientResults results = fake_results(Side::left);
  results.views.pop_back();
  results.rows.clear();
  results.stages.pop_back();
  results.stages.back().sidecar["status"] = "not_converged";
  results.stages.back().sidecar["reasons"] = {"stopped at 71.3 mm"};
  const std::string page = render_page(page_data(results, "0.1.0"));
  EXPECT_NE(page.find("Not converged"), std::string::npos);
  EXPECT_NE(page.find("stopped at 71.3 mm"), std::string::npos);
  EXPECT_NE(page.find("L-CC, simulated from"), std::string::npos);
}

TEST(ReportPicture, IsAPngWithoutAnXServer) {
  const fs::path png = scratch_file("overview.png");
  overview_picture(fake_results(Side::left)).write_png(png, 1);
  EXPECT_EQ(text_of(png).substr(1, 3), "PNG");
  EXPECT_GT(fs::file_size(png), 50000u);  // a blank sheet of its size takes a few thousand bytes
}

}  // namespace
}  // namespace mammotwin
