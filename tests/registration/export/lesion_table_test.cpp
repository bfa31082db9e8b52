#include "registration/export/lesion_table.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "registration/export/predictions_text.h"
#include "registration/view/breast_position.h"
#include "tests/file_text.h"
#include "tests/registration/squeezed_box.h"
#include "tests/scratch_file.h"

namespace mammotwin {
namespace {

TEST(BreastPosition, ReadsTheClockFacingThePatient) {
  const Eigen::Vector3d nipple(0, 0, 0);
  const auto at = [&](Side side, double left, double up) {
    const BreastPosition p = breast_position(side, {left, 0, up}, nipple);
    return p.quadrant + " " + p.clock;
  };
  EXPECT_EQ(at(Side::left, 20, 20), "upper outer 2");  // atan2(20, 20) = 45 deg: 1.5 -> 2
  EXPECT_EQ(at(Side::left, 30, 1), "upper outer 3");
  EXPECT_EQ(at(Side::right, 30, 1), "upper inner 3");
  EXPECT_EQ(at(Side::right, -30, -1), "lower outer 9");
  EXPECT_EQ(at(Side::left, -1, 30), "upper inner 12");
  EXPECT_EQ(at(Side::left, 1, -30), "lower outer 6");
  EXPECT_EQ(at(Side::left, -4, 30), "upper inner 12");  // 352 deg rounds up to a full turn
  EXPECT_EQ(at(Side::left, 3, 4), "central ");
}

// Nipple at y = -60, 1 mm voxels of fat from there to y = 0, then muscle.
TEST(DepthThird, CountsFromTheNippleToTheMuscle) {
  Segmentation s;
  s.labels = Volume<std::uint8_t>({3, 80, 3}, {1, 1, 1}, {-1, -70, -1}, label::air);
  s.nipple_in_lps = {0, -60, 0};
  for (int k = 0; k < 3; ++k)
    for (int j = 10; j < 80; ++j)
      for (int i = 0; i < 3; ++i) s.labels(i, j, k) = j <= 70 ? label::fat : label::muscle;
  EXPECT_EQ(depth_third(s, {5, -62, 0}), "anterior");
  EXPECT_EQ(depth_third(s, {5, -40.1, 0}), "anterior");
  EXPECT_EQ(depth_third(s, {5, -39.9, 0}), "middle");
  EXPECT_EQ(depth_third(s, {5, -20.1, 0}), "middle");
  EXPECT_EQ(depth_third(s, {5, -19.9, 0}), "posterior");
  s.nipple_in_lps.x() = 30;  // beside the image
  EXPECT_EQ(depth_third(s, {5, -40, 0}), "");
}

TEST(PredictionsText, KeepsANameWithACommaTogether) {
  LesionRow mri, view;
  mri.lesion = view.lesion = "a, \"b\"";
  mri.view = "mri", view.view = "cc";
  view.depth_mm = 12.34, view.lateral_mm = -5, view.height_mm = 20;
  view.detector_u_mm = 13, view.detector_v_mm = -5.25;
  view.registration = "no registration";
  const auto path = scratch_file("predictions.csv");
  write_lesion_table(path, {mri, view});
  const std::string text = predictions_text(read_lesion_table(path));
  EXPECT_NE(
      text.find("a, \"b\"   CC   depth 12.3  lateral -5.0  height 20.0  on the detector (13.0, "
                "-5.2)  no registration"),
      std::string::npos)
      << text;
  EXPECT_EQ(predictions_text({mri}), "");
}

TEST(LesionTable, HasTheColumnsThatOthersRead) {
  const auto path = scratch_file("columns.csv");
  write_lesion_table(path, {});
  EXPECT_EQ(
      text_of(path),
      "patient,lesion,view,side,volume_ml,mri_l_mm,mri_p_mm,mri_s_mm,depth_mm,lateral_mm,height_mm,"
      "detector_u_mm,detector_v_mm,pixel_column,pixel_row,slice,registration,ellipse_major_mm,"
      "ellipse_minor_mm,ellipse_angle_deg,picture_ellipse_major_mm,picture_ellipse_minor_mm,"
      "picture_ellipse_angle_deg,baseline_u_mm,baseline_v_mm,behind_nipple_mm,"
      "lateral_of_nipple_mm,above_nipple_mm,nipple_distance_mm,quadrant,clock,third,"
      "supine_skin_l_mm,supine_skin_p_mm,supine_skin_s_mm,supine_depth_mm,supine_from_nipple_mm,"
      "supine_clock,supine_semi_l_mm,supine_semi_p_mm,supine_semi_s_mm\n");
}

TEST(LesionTable, HasADictionaryOfEveryColumn) {
  const auto table = scratch_file("all.csv"), dictionary = scratch_file("all.md");
  write_lesion_table(table, {});
  write_lesion_dictionary(dictionary);
  const std::string text = text_of(dictionary);
  std::istringstream columns(text_of(table));
  int count = 0;
  for (std::string column; std::getline(columns >> std::ws, column, ',');) {
    while (!column.empty() && column.back() == '\n') column.pop_back();
    EXPECT_NE(text.find("| `" + column + "` | "), std::string::npos) << column;
    ++count;
  }
  EXPECT_EQ(count, 41);
  EXPECT_NE(text.find("| `pixel_row` | pixel |"), std::string::npos);
  EXPECT_NE(text.find("| `ellipse_angle_deg` | deg |"), std::string::npos);
  EXPECT_NE(text.find("| `clock` | text |"), std::string::npos);
}

TEST(LesionTable, ComesBackAsItWasWritten) {
  LesionRow row;
  row.patient = "042";
  row.lesion = "mass, \"A\"";
  row.view = "cc";
  row.mri_l_mm = -12.3456;
  row.height_mm = -1e-9;  // must not become -0.000
  const auto path = scratch_file("round.csv");
  write_lesion_table(path, {row});
  EXPECT_NE(text_of(path).find("042,\"mass, \"\"A\"\"\",cc,,,-12.346,,,,,0.000,"),
            std::string::npos);
  const LesionRow read = read_lesion_table(path).at(0);
  EXPECT_EQ(read.lesion, row.lesion);
  EXPECT_EQ(read.mri_l_mm, -12.346);
  EXPECT_FALSE(read.mri_p_mm.has_value());
}

TEST(LesionTable, NamesTheCellThatCannotBeRead) {
  const auto path = scratch_file("bad.csv");
  write_lesion_table(path, {});
  std::ofstream(path, std::ios::app) << "042,1,cc,left,,twelve" << std::string(35, ',') << "\n";
  try {
    read_lesion_table(path);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("line 2: column mri_l_mm is \"twelve\""),
              std::string::npos)
        << error.what();
  }
}

TEST(LesionRows, MeasureFromTheNippleInTheImagePlane) {
  for (const Side side : {Side::left, Side::right}) {
    const double out = side == Side::left ? 1 : -1;
    const Landmark lesion{"1", {out * 80, -30, 10}}, nipple{"nipple", {out * 70, -60, 0}};
    const SqueezedBox cc = squeezed_box(side, 0, 0.5);
    const ViewProjection p(cc.prone, cc.compressed, cc.view, Detector{});
    const LesionRow row = view_row("042", cc.view, p.project(lesion), p.project(nipple));
    EXPECT_GT(*row.behind_nipple_mm, 0);
    EXPECT_GT(*row.lateral_of_nipple_mm, 0);  // 10 mm outer in the MRI
    EXPECT_FALSE(row.above_nipple_mm.has_value());
    EXPECT_NEAR(*row.nipple_distance_mm,
                std::hypot(*row.behind_nipple_mm, *row.lateral_of_nipple_mm), 1e-9);

    const SqueezedBox mlo = squeezed_box(side, 45, 0.5);
    const ViewProjection q(mlo.prone, mlo.compressed, mlo.view, Detector{});
    const LesionRow oblique = view_row("042", mlo.view, q.project(lesion), q.project(nipple));
    EXPECT_FALSE(oblique.lateral_of_nipple_mm.has_value());
    EXPECT_GT(*oblique.above_nipple_mm, 0);

    const LesionRow mri = mri_row("042", side, lesion, nipple.prone_in_lps);
    EXPECT_NEAR(*mri.behind_nipple_mm, 30, 1e-12);
    EXPECT_NEAR(*mri.lateral_of_nipple_mm, 10, 1e-12);
    EXPECT_NEAR(*mri.above_nipple_mm, 10, 1e-12);
    EXPECT_EQ(mri.quadrant, "upper outer");
  }
}

}  // namespace
}  // namespace mammotwin
