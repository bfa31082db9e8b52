// The page in Chromium: what a person can do with it, and that it keeps to itself.

#include <sstream>

#include "pipeline/evaluate/page/browser.h"
#include "pipeline/report/page_data.h"
#include "pipeline/report/page_template.h"
#include "registration/carry/ray_curve.h"
#include "tests/pipeline/report/report_fake_results.h"
#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

PatientResults with_ellipses(PatientResults results) {
  for (LesionRow& row : results.rows)
    if (row.view != "mri")
      row.ellipse_major_mm = 16, row.ellipse_minor_mm = 11, row.ellipse_angle_deg = 20;
  return results;
}

constexpr double kFurther_mm = 2;  // along depth, by a standard deviation more of thickness
// Along depth at the ends of the slider.
constexpr double kFurtherUp_mm = 3, kFurtherDown_mm = -1;

/// Sensitivities to thickness, turn and shifts alone.
PatientResults with_sensitivities(PatientResults results) {
  for (ViewResult& view : results.views) {
    view.uncertainty.emplace();
    const auto along_depth = [&](double by) {
      Nodes nodes = view.file.mesh.nodes();
      for (HermiteMesh::Node& node : nodes)
        node.col(0) += by * view.view.frame.axes.row(0).transpose();
      return nodes;
    };
    view.uncertainty->varied[kThickness] = along_depth(kFurther_mm);
    view.what_if[0] = {along_depth(kFurtherUp_mm), along_depth(kFurtherDown_mm)};
  }
  return results;
}

Eigen::Vector2d pair_of(const nlohmann::json& x) {
  return {x.at(0).get<double>(), x.at(1).get<double>()};
}

/// As JavaScript has a list.
std::string list(const Eigen::VectorXd& x) {
  std::string text;
  for (const double number : x) text += (text.empty() ? "[" : ", ") + std::to_string(number);
  return text + "]";
}

class ReportInABrowser : public ScratchFolder {
 protected:
  void SetUp() override {
    if (Browser::program().empty()) GTEST_SKIP() << "there is no Chromium (package chromium)";
    browser_.emplace(folder_ / "profile");
    browser_->open(write("report.html", render_page(page_data(results_, "0.1.0"))));
    for (const char* ready : {"document.getElementById('planes').dataset.ready",
                              "document.getElementById('carry').dataset.ready",
                              "document.getElementById('viewer').dataset.lesion"})
      ASSERT_TRUE(browser_->wait_until(ready)) << ready;  // each moves what stands below it
  }
  void TearDown() override { browser_.reset(); }

  std::string at_the_cross() {
    return browser_->evaluate("document.getElementById('planes-status').textContent");
  }
  /// Pixels of a plane (0: axial, 1: sagittal, 2: coronal), as text.
  std::string picture_of(int plane) {
    return browser_->evaluate("document.querySelectorAll('#planes canvas')[" +
                              std::to_string(plane) + "].toDataURL()");
  }
  Eigen::Vector3d lesion_in_3d() {
    std::istringstream text(
        browser_->evaluate("document.getElementById('viewer').dataset.lesion").get<std::string>());
    Eigen::Vector3d x;
    text >> x.x() >> x.y() >> x.z();
    return x;
  }

  /// Until the cross is where its words hold `text`, or no longer.
  bool cross_says(const std::string& text, bool yes = true) {
    return browser_->wait_until(std::string(yes ? "" : "!") +
                                "document.getElementById('planes-status').textContent.includes('" +
                                text + "')");
  }

  void go_through_slices_by_keyboard() {
    EXPECT_TRUE(browser_->has_accessible("slider", "Axial"));
    browser_->evaluate("document.querySelector('#planes figure input').focus()");
    browser_->press("ArrowRight");
    EXPECT_TRUE(cross_says("S −10.0 mm")) << at_the_cross();
    EXPECT_EQ(browser_->evaluate(
                  "document.querySelector('#planes figure input').getAttribute('aria-valuetext')"),
              "S −10.0 mm");
  }
  void print_the_stills() {
    const auto pdf = browser_->call("Page.printToPDF", {{"printBackground", true}});
    EXPECT_EQ(pdf["data"].get<std::string>().substr(0, 4), "JVBE");  // %PDF in base64
    const std::string open = "document.querySelector('details.stills').open";
    EXPECT_EQ(browser_->evaluate(open), false);  // as before
    browser_->evaluate("window.dispatchEvent(new Event('beforeprint'))");
    EXPECT_EQ(browser_->evaluate(open), true);
  }

  PatientResults results_ = with_sensitivities(with_ellipses(fake_results(Side::left)));
  std::optional<Browser> browser_;
};

// Lesion 2 of the made-up breast has its centroid at (65, -52, -12); voxels are 2 mm.
TEST_F(ReportInABrowser, FindsALesionByItsLabelAndMovesThePlanes) {
  EXPECT_TRUE(browser_->has_accessible("button", "Lesion 2"));
  browser_->click("#planes-places button:nth-child(2)");
  EXPECT_TRUE(cross_says("lesion 2"));
  EXPECT_EQ(at_the_cross(), "L 65.0, P −52.0, S −12.0 mm: lesion 2");
  const std::string axial = picture_of(0), sagittal = picture_of(1), coronal = picture_of(2);
  browser_->click("#planes figure:nth-child(1) canvas", 0.2, 0.1);  // in the axial plane
  EXPECT_TRUE(cross_says("L 65.0", false)) << at_the_cross();
  EXPECT_NE(picture_of(1), sagittal);
  EXPECT_NE(picture_of(2), coronal);
  EXPECT_NE(at_the_cross().find("S −12.0 mm"), std::string::npos);  // that plane itself stays
  EXPECT_NE(picture_of(0), axial);                                  // but for its cross
  go_through_slices_by_keyboard();
}

// The unloaded shape of the made-up breast is the prone one.
TEST_F(ReportInABrowser, CompressesWithTheSlider) {
  const Landmark lesion = results_.lesions()[0];
  const PointCarrier carrier(results_.prone->mesh, results_.view("cc")->file.mesh);
  const Eigen::Vector3d squeezed = carrier.carry(lesion.prone_in_lps).in_lps;
  EXPECT_LT((lesion_in_3d() - squeezed).norm(), 0.02);  // two decimals
  EXPECT_GT((lesion.prone_in_lps - squeezed).norm(), 1);
  browser_->evaluate("document.getElementById('viewer-compression').focus()");
  browser_->press("Home");
  EXPECT_LT((lesion_in_3d() - lesion.prone_in_lps).norm(), 0.02);
  browser_->press("End");
  EXPECT_LT((lesion_in_3d() - squeezed).norm(), 0.02);
  for (const char* shape : {"Prone", "Unloaded", "CC", "MLO"})
    EXPECT_TRUE(browser_->has_accessible("radio", shape)) << shape;
}

TEST_F(ReportInABrowser, SaysWhereAndHowSureOnTheFirstScreen) {
  for (const auto& [width, height] : {std::pair(1366, 768), std::pair(390, 844)}) {
    browser_->call(
        "Emulation.setDeviceMetricsOverride",
        {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
    browser_->evaluate("window.scrollTo(0, 0)");
    EXPECT_LE(browser_->evaluate("document.querySelector('.card').getBoundingClientRect().bottom"),
              height);
    EXPECT_LE(browser_->evaluate("document.documentElement.scrollWidth"), width);
  }
}

TEST_F(ReportInABrowser, SwitchesMarksOff) {
  const std::string shown = "getComputedStyle(document.querySelector('.layer.ellipses')).display";
  EXPECT_EQ(browser_->evaluate(shown), "block");
  browser_->click("#marks input[value=ellipses]");
  EXPECT_EQ(browser_->evaluate(shown), "none");
  EXPECT_TRUE(browser_->has_accessible("checkbox", "Search ellipse (90 %)"));
}

// The sliders' script and the stages' own formula say the same. The lesion is 3 mm further from the
// edge at one end of thickness and 1 mm nearer at the other, so that halfway up it is 3/8 x 3 -
// 1/8 x -1 = 1.25 mm further; enlarged by the beam.
TEST_F(ReportInABrowser, MovesLesionAndEllipseWithTheSliders) {
  const ViewResult& cc = *results_.view("cc");
  const ViewProjection projection(results_.prone->mesh, cc.file.mesh, cc.view, cc.detector);
  const ProjectedLandmark lesion = projection.project(results_.lesions()[0]);
  const auto at = [&](const char* what) {
    return browser_->evaluate(std::string("mammotwin.whatIf('cc', 0).") + what);
  };
  EXPECT_LT((pair_of(at("uv")) - lesion.on_detector).norm(), 1e-3);  // single precision
  const SearchEllipse ellipse = search_ellipse(
      detector_covariance(*cc.uncertainty, cc.file.mesh, cc.view, cc.detector, lesion.point), 0.9);
  EXPECT_NEAR(at("ellipse.major").get<double>(), ellipse.major_mm, 1e-3);
  EXPECT_NEAR(at("ellipse.minor").get<double>(), ellipse.minor_mm, 1e-3);

  browser_->evaluate("document.querySelector('#what-if input[name=thickness_mm]').focus()");
  browser_->press("End");
  const auto expect_further = [&](double by) {
    const Eigen::Vector3d moved = lesion.in_view + Eigen::Vector3d(by, 0, 0);
    EXPECT_LT((pair_of(at("uv")) - cc.detector.project(moved)).norm(), 1e-3) << by;
  };
  expect_further(kFurtherUp_mm);
  EXPECT_TRUE(browser_->wait_until("document.querySelector('.view[data-view=cc].moved')"));
  browser_->press("Home");
  expect_further(kFurtherDown_mm);
  browser_->evaluate(
      "{ const slider = document.querySelector('#what-if input[name=thickness_mm]'); slider.value "
      "= slider.max / 2;"
      " slider.dispatchEvent(new Event('input')); }");
  expect_further(1.25);
  browser_->click("#what-if-back");
  EXPECT_TRUE(browser_->wait_until("!document.querySelector('.view.moved')"));
}

// The page's grids of 4 mm against the mesh itself: an affine map, so that only 0.02 mm steps are
// lost; at the skin, where nodes outside are carried on, no more.
TEST_F(ReportInABrowser, CarriesMarksBetweenViewsAndMri) {
  const ViewResult& cc = *results_.view("cc");
  const ViewProjection projection(results_.prone->mesh, cc.file.mesh, cc.view, cc.detector);
  const ViewRays rays(results_.prone->mesh, cc.file.mesh, cc.view, cc.detector);
  const Landmark lesion = results_.lesions()[0];
  const Eigen::Vector2d uv = projection.project(lesion).on_detector;
  const auto seen = browser_->evaluate("mammotwin.seen('cc', " + list(lesion.prone_in_lps) + ")");
  EXPECT_LT((pair_of(seen) - uv).norm(), 0.3);
  const auto curve = browser_->evaluate("mammotwin.curve('cc', " + list(uv) + ")");
  const std::vector<RayPoint> truth = rays.curve(uv, 0.25);
  ASSERT_GT(curve.size(), 20u);
  EXPECT_NEAR(static_cast<double>(curve.size()), truth.size() / 4.0, 4);  // ends within 2 mm
  for (const auto& x : curve) {
    double nearest = 1e9;
    for (const RayPoint& p : truth)
      nearest = std::min(
          nearest, (p.prone_in_lps -
                    Eigen::Vector3d(x[0].get<double>(), x[1].get<double>(), x[2].get<double>()))
                       .norm());
    EXPECT_LT(nearest, 0.6);  // a fifth of a millimetre of height is up to half of one prone
  }
}

TEST_F(ReportInABrowser, MarksByAClickOnAViewAndClearsThem) {
  const std::string said = "document.getElementById('carry-status').textContent";
  browser_->click(".view[data-view=cc] canvas", -0.2);
  EXPECT_NE(browser_->evaluate(said).get<std::string>().find("Mark on CC"), std::string::npos);
  EXPECT_EQ(browser_->evaluate("mammotwin.panes.get('mlo').layers.has('mark')"), true);
  browser_->click("#carry-clear");
  EXPECT_EQ(browser_->evaluate("mammotwin.panes.get('mlo').layers.has('mark')"), false);
  browser_->click("#planes-places button");  // a place in the MRI
  EXPECT_NE(browser_->evaluate(said).get<std::string>().find("MLO u "), std::string::npos);
}

TEST_F(ReportInABrowser, ZoomsAndWindowsTheViewsAndLetsSwipesScroll) {
  browser_->click("#zoom-in");
  EXPECT_GT(browser_->evaluate("mammotwin.panes.get('cc').zoom"), 1.5);
  const std::string touch = "mammotwin.panes.get('cc').canvas.style.touchAction";
  EXPECT_EQ(browser_->evaluate(touch), "none");  // a finger moves what is enlarged
  browser_->click("#zoom-none");
  EXPECT_EQ(browser_->evaluate("mammotwin.panes.get('cc').zoom"), 1);
  EXPECT_EQ(browser_->evaluate(touch), "manipulation");
  EXPECT_EQ(  // what pan-x, pan-y and pinch-zoom are together
      browser_->evaluate("getComputedStyle(document.querySelector('#planes canvas')).touchAction"),
      "manipulation");
  browser_->evaluate("document.getElementById('grey-window').focus()");
  browser_->press("Home");  // 5 % of the greys
  EXPECT_EQ(browser_->evaluate("document.querySelector('#greys feFuncR').getAttribute('slope')"),
            "20");
}

TEST_F(ReportInABrowser, PrintsAsksForNothingAndComplainsOfNothing) {
  print_the_stills();
  for (const std::string& url : browser_->requests())
    EXPECT_TRUE(url.starts_with("file://" + folder_.string()) || url.starts_with("data:") ||
                url.starts_with("blob:"))
        << url;
  EXPECT_GE(browser_->requests().size(), 1u);  // the page itself: the count works
  for (const std::string& complaint : browser_->complaints()) ADD_FAILURE() << complaint;
  // Time to the first picture, to be read and not to be judged on a machine that does other things.
  const auto first =
      browser_->evaluate("performance.getEntriesByName('first-contentful-paint')[0]?.startTime");
  RecordProperty("first_contentful_paint_ms", first.dump());
  RecordProperty(
      "planes_ms",
      browser_->evaluate("document.getElementById('planes').dataset.ready").get<std::string>());
}

}  // namespace
}  // namespace mammotwin
