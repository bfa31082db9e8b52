#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "fitting/mesh/block_mesh.h"
#include "pipeline/report/drawing/depth_image.h"
#include "pipeline/report/drawing/lesion_outline.h"
#include "pipeline/report/drawing/mammogram_raster.h"
#include "pipeline/report/drawing/mesh_field.h"
#include "pipeline/report/drawing/mesh_surface.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/drawing/section.h"
#include "pipeline/report/figures/doubt_figure.h"
#include "pipeline/report/figures/fit_course_figure.h"
#include "pipeline/report/figures/fit_error.h"
#include "pipeline/report/live/base64.h"
#include "pipeline/report/live/what_if_data.h"
#include "pipeline/report/quality_limit.h"
#include "pipeline/report/quality_table.h"
#include "pipeline/report/verdict.h"
#include "tests/pipeline/report/report_fake_results.h"

namespace mammotwin {
namespace {

MeshFile block() { return {block_mesh({0, 0, 0}, {2, 3, 4}, {2, 1, 2}), {}, {}, {}, {}, {}}; }

TEST(MeshSurface, CountsEveryFaceOnce) {
  // 2 x 1 x 2 elements: 3*1*2 + 2*2*2 + 2*1*3 = 20 faces, of which 4 lie between two elements.
  EXPECT_EQ(all_faces(block()).size(), 20u);
  EXPECT_EQ(outer_faces(block()).size(), 16u);
}

TEST(MeshSurface, TrianglesLookOutwards) {
  const MeshFile file = block();
  const FaceTriangles s = triangulate(file.mesh, outer_faces(file), 3);
  double volume = 0;  // divergence theorem: a sum of signed tetrahedra
  for (const auto& [a, b, c] : s.triangles)
    volume += s.points[a].dot(s.points[b].cross(s.points[c])) / 6;
  EXPECT_NEAR(volume, 24, 1e-12);
}

TEST(MeshSurface, PlaneCutsABlockAlongItsOutlineAndItsInnerFaces) {
  const MeshFile file = block();
  double outline = 0, all = 0;
  for (const auto& [a, b] : cut_by_plane(file.mesh, outer_faces(file), 2, 1.1))
    outline += (b - a).norm();
  for (const auto& [a, b] : cut_by_plane(file.mesh, all_faces(file), 2, 1.1)) all += (b - a).norm();
  EXPECT_NEAR(outline, 2 * (2 + 3), 1e-12);
  EXPECT_NEAR(all, outline + 3, 1e-12);
}

TEST(Section, TurnsAxesAndBack) {
  Section s;
  s.normal = 0;
  s.at = 5;
  s.right = {1};
  s.down = {2, true};
  s.window = Eigen::AlignedBox3d(Eigen::Vector3d(0, -10, -20), Eigen::Vector3d(1, 30, 40));
  EXPECT_EQ(s.on_paper({5, -10, 40}), Eigen::Vector2d(0, 0));
  const Eigen::Vector3d x(5, 12, -3);
  EXPECT_LT((s.in_space(s.on_paper(x)) - x).norm(), 1e-12);
}

TEST(DepthImage, KeepsWhatIsNearest) {
  const Colour red{1, 0, 0}, blue{0, 0, 1};
  const auto triangle = [](double z) {
    return std::array<Eigen::Vector3d, 3>{{{-9, -9, z}, {20, -9, z}, {-9, 20, z}}};
  };
  for (const bool near_first : {true, false}) {
    DepthImage image(4, 4, {0, 0}, 1);
    image.triangle(triangle(near_first ? 2 : 1), near_first ? red : blue);
    image.triangle(triangle(near_first ? 1 : 2), near_first ? blue : red);
    EXPECT_EQ(image.raster().pixels[5].red, 1);
  }
}

TEST(QualityTable, NamesUnitsAndUnfoldsLists) {
  const auto figures = quality_figures(nlohmann::json::parse(
      R"({"force_N": 86.41234, "min_J": null, "nipple_lps_mm": [1.5, -2, 3],
          "lesions": [{"id": "2a", "volume_ml": 0.4}], "history": [{"force_N": 1}]})"));
  ASSERT_EQ(figures.size(), 4u);
  EXPECT_EQ(figures[0].name + "|" + figures[0].value + "|" + figures[0].unit, "force|86.41|N");
  EXPECT_EQ(figures[1].name + "|" + figures[1].value + "|" + figures[1].unit,
            "lesions 2a, volume|0.4|ml");
  EXPECT_EQ(figures[2].value, "not known");
  EXPECT_EQ(figures[3].value + figures[3].unit, "(1.5, -2, 3)mm");
}

TEST(Verdict, IsTheWorstOfTheStages) {
  PatientResults results = fake_results(Side::left);
  EXPECT_EQ(verdict_data(results)["status"], "ok");
  results.stages[1].sidecar["status"] = "look";
  EXPECT_EQ(verdict_data(results)["status"], "look");
  results.stages[2].sidecar["status"] = "not_converged";
  results.stages[0].sidecar["status"] = "refused";
  EXPECT_EQ(verdict_data(results)["status"], "refused");
  results = fake_results(Side::left);
  results.stages.pop_back();
  EXPECT_EQ(verdict_data(results)["status"], "incomplete");
}

/// Linear light of an sRGB colour (IEC 61966-2-1).
Eigen::Vector3d light_of(const Colour& c) {
  const auto linear = [](double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return {linear(c.red), linear(c.green), linear(c.blue)};
}

double contrast(const Colour& a, const Colour& b) {  // WCAG 2.2
  const Eigen::Vector3d weights(0.2126, 0.7152, 0.0722);
  const double one = weights.dot(light_of(a)), other = weights.dot(light_of(b));
  return (std::max(one, other) + 0.05) / (std::min(one, other) + 0.05);
}

/// CIE L*a*b* (D65) of linear light.
Eigen::Vector3d lab_of(const Eigen::Vector3d& light) {
  Eigen::Matrix3d xyz_from_rgb;
  xyz_from_rgb << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339,
      0.1191920, 0.9503041;
  const Eigen::Vector3d xyz =
      (xyz_from_rgb * light).cwiseQuotient(Eigen::Vector3d(0.95047, 1, 1.08883));
  const auto f = [](double t) {
    return t > 216. / 24389 ? std::cbrt(t) : (24389. / 27 * t + 16) / 116;
  };
  return {116 * f(xyz.y()) - 16, 500 * (f(xyz.x()) - f(xyz.y())), 200 * (f(xyz.y()) - f(xyz.z()))};
}

/// The smallest colour difference (CIE 1976) for people with normal vision and without one kind of
/// cone: Machado, Oliveira and Fernandes 2009, severity 1.
double told_apart(const Colour& a, const Colour& b) {
  Eigen::Matrix3d protan, deutan, tritan;
  protan << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116,
      1.051998;
  deutan << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940,
      0.968881;
  tritan << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367,
      0.303900;
  double least = 1e9;
  for (const Eigen::Matrix3d& seen :
       {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), protan, deutan, tritan}) {
    const auto as_seen = [&](const Colour& c) {
      return lab_of((seen * light_of(c)).cwiseMax(0).cwiseMin(1));
    };
    least = std::min(least, (as_seen(a) - as_seen(b)).norm());
  }
  return least;
}

// A just noticeable difference is 2.3; 20 is told apart at a glance. Red and green of equal
// lightness, which are not, have less.
TEST(Palette, IsToldApartWithEveryKindOfColourVision) {
  EXPECT_LT(told_apart({0.7, 0.25, 0.22}, {0.35, 0.42, 0.2}), 20);
  const std::vector<std::vector<Colour>> shown_together = {
      {palette::lesion, palette::nipple, palette::baseline},
      {palette::lesion, palette::nipple, palette::third_line},
      {palette::skin, palette::fat, palette::of_label(label::fibroglandular), palette::muscle,
       palette::lesion}};
  for (const auto& colours : shown_together)
    for (std::size_t i = 0; i < colours.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GT(told_apart(colours[i], colours[j]), 20) << i << " and " << j;
}

TEST(Palette, OneEdgeOfAMarkIsSeenOnAnyGrey) {
  for (int grey = 0; grey <= 255; ++grey) {
    const Colour tissue{grey / 255.0, grey / 255.0, grey / 255.0};
    EXPECT_GE(std::max(contrast(palette::light_edge, tissue), contrast(palette::dark_edge, tissue)),
              3)
        << grey;
  }
}

// The outermost voxels (2 mm) of the ball whose radius is less than 6 mm lie 8 mm apart; along the
// plates that is stretched by 1 / sqrt(50 / 120), by the cone enlarged by 660 / 635 in the middle,
// and each voxel counts as a ball of 1.24 mm.
TEST(LesionOutline, IsAsLargeAsTheLesionsShadow) {
  const PatientResults results = fake_results(Side::left);
  const ViewResult& view = *results.view("cc");
  const ViewProjection projection(results.prone->mesh, view.file.mesh, view.view, view.detector);
  const auto outline = lesion_outline(results.segmentation->labels, label::lesion, projection);
  ASSERT_FALSE(outline.empty());
  Eigen::AlignedBox2d box;
  double length = 0;
  for (const auto& [a, b] : outline) box.extend(a).extend(b), length += (b - a).norm();
  const double width = 8 / std::sqrt(50.0 / 120) * 660 / 635 + 2 * 1.24;
  EXPECT_NEAR(box.sizes().x(), width, 1);  // two steps of the grid
  EXPECT_NEAR(box.sizes().y(), width, 1);
  EXPECT_LT(length, 2 * box.sizes().sum());  // one line round it: no holes
  const Landmark lesion = results.lesions()[0];
  EXPECT_LT((box.center() - projection.project(lesion).on_detector).norm(), 1);
  EXPECT_TRUE(lesion_outline(results.segmentation->labels, 99, projection).empty());
}

TEST(Base64, PadsAsOthersRead) {
  EXPECT_EQ(base64("", 0), "");
  EXPECT_EQ(base64("f", 1), "Zg==");  // RFC 4648, section 10
  EXPECT_EQ(base64("foobar", 6), "Zm9vYmFy");
}

// The made-up error is 0.01 z over |z| <= 60 mm.
TEST(FitFigure, SaysTheRangeOfTheErrorThatItPaints) {
  const auto figure = fit_figure(fake_results(Side::left));
  ASSERT_TRUE(figure);
  EXPECT_NE(figure->caption.find("from -0.60 mm (inside) to 0.60 mm (outside)"), std::string::npos);
}

TEST(FitFigure, GrowsRedderOutsideAndBluerInside) {
  EXPECT_GT(fit_error_colour(0.5).red, fit_error_colour(0.5).blue);
  EXPECT_LT(fit_error_colour(-0.5).red, fit_error_colour(-0.5).blue);
  EXPECT_EQ(fit_error_colour(1).green, fit_error_colour(7).green);  // ends at 1 mm
}

TEST(FitCourseFigure, ShowsWhatTheFitLeftOfItsIterations) {
  PatientResults results = fake_results(Side::left);
  EXPECT_FALSE(fit_course_figure(results));
  for (StageRecord& stage : results.stages)
    if (stage.product == "prone.vtu")
      stage.sidecar["quality"]["skin_rms_by_iteration_mm"] = {2.5, 0.61, 0.3, 0.24};
  const auto figure = fit_course_figure(results);
  ASSERT_TRUE(figure);
  EXPECT_NE(figure->alt.find("from 2.50 to 0.24 mm RMS in 3 iterations"), std::string::npos)
      << figure->alt;
}

// A field that is linear in position is its own cubic interpolant.
TEST(WhatIfData, LeavesOutAViewThatSlipsBetweenThePlates) {
  PatientResults results = fake_results(Side::left);
  for (ViewResult& view : results.views) {
    view.uncertainty.emplace();
    view.what_if[0] = {view.file.mesh.nodes(), view.file.mesh.nodes()};
  }
  const ViewResult& cc = *results.view("cc");
  EXPECT_EQ(what_if_data(results, cc)["numbers"].size(), 1U);
  for (StageRecord& stage : results.stages)
    if (stage.product == "cc.vtu") stage.sidecar["quality"]["swing_mm"] = -25.9;
  EXPECT_TRUE(what_if_data(results, cc).is_null());
  EXPECT_FALSE(what_if_data(results, *results.view("mlo")).is_null());
}

TEST(MeshField, ReadsWhatWasInterpolated) {
  const HermiteMesh mesh = block_mesh({0, 0, 0}, {2, 3, 4}, {2, 1, 2});
  const auto linear = [&](const MeshPoint& p) {
    return mesh.position(p).dot(Eigen::Vector3d(1, -2, 0.5));
  };
  const MeshField field(mesh, interpolate_field(mesh, linear));
  for (const Eigen::Vector3d& xi : {Eigen::Vector3d(0.1, 0.7, 0.4), Eigen::Vector3d(1, 0, 0.9)})
    EXPECT_NEAR(field.at({3, xi}), linear({3, xi}), 1e-12);
  EXPECT_THROW(MeshField(mesh, PointField{1, {1.0, 2.0}}), std::invalid_argument);
}

// Pixels of 0.5 mm from the edge: columns 0 to 9 are dark, the rest bright.
TEST(MammogramRaster, PutsPixelsWhereTheDetectorHasThem) {
  MammogramImage image{20, 20, std::vector<float>(400, 100)};
  Detector detector;
  detector.pixels = PixelGrid{0.5, 20, 20, ImageEdge::left, true};
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 10; ++column) image.grey[row * 20 + column] = 0;
  const Section section{2,
                        0,
                        {0},
                        {1, true},
                        Eigen::AlignedBox3d(Eigen::Vector3d(-2, -4, 0), Eigen::Vector3d(14, 4, 0))};
  Raster raster = mammogram_raster(image, detector, section, 1);
  EXPECT_EQ(raster(1, 4).red, palette::grid.red);   // behind the edge
  EXPECT_EQ(raster(4, 4).red, 0);                   // u = 2.5 mm
  EXPECT_EQ(raster(9, 4).red, 1);                   // u = 7.5 mm
  EXPECT_EQ(raster(15, 4).red, palette::grid.red);  // past the image
}

TEST(QualityLimit, SaysWhatIsExpectedAndWhetherItHolds) {
  const nlohmann::json quality = {{"volume_change", -0.03},
                                  {"thickness_mm", 50.05},
                                  {"target_thickness_mm", 50.0},
                                  {"force_N", 80},
                                  {"contact_area_cm2", 40}};
  const auto volume = expectation("cc.vtu", "volume_change", quality);
  ASSERT_TRUE(volume);
  EXPECT_EQ(volume->words, "within ± 0.01");
  EXPECT_FALSE(volume->held);
  const auto thickness = expectation("mlo.vtu", "thickness_mm", quality);
  ASSERT_TRUE(thickness);
  EXPECT_EQ(thickness->words, "50.00 ± 0.10 mm");
  EXPECT_TRUE(thickness->held);
  EXPECT_FALSE(expectation("cc.vtu", "contact_area_cm2", quality));
  EXPECT_FALSE(expectation("prone.vtu", "volume_change", quality));
}

TEST(DoubtFigure, ShowsWhereTheSegmentationIsDoubted) {
  const PatientResults results = fake_results(Side::left);
  const Eigen::Vector3d x = results.segmentation->nipple_in_lps;
  nlohmann::json doubt = {{"what", "nipple"},
                          {"reason", "the nipple shows weakly"},
                          {"place_lps_mm", {x.x(), x.y(), x.z()}},
                          {"radius_mm", 15}};
  const auto figure = doubt_figure(results, doubt);
  ASSERT_TRUE(figure);
  EXPECT_NE(figure->caption.find("nipple at L"), std::string::npos) << figure->caption;
  EXPECT_NE(figure->caption.find("shows weakly"), std::string::npos);
  doubt["place_lps_mm"] = nullptr;
  EXPECT_FALSE(doubt_figure(results, doubt)) << "of the whole image";
}

}  // namespace
}  // namespace mammotwin
