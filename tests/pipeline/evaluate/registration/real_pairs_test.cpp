#include <nlohmann/json.hpp>

#include "pipeline/evaluate/registration/real_pair_rows.h"
#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

using nlohmann::json;

const std::string kHeader = "lesion,view,column,row,pixel_spacing_mm,spacing,edge_column\n";

class RealPairs : public ScratchFolder {
 protected:
  std::vector<RealMark> marks(const std::string& lines) const {
    return read_real_marks(write("marks.csv", kHeader + lines));
  }
};

/// A prediction 30 mm from the edge whose 90 % ellipse has semi-axes of 20 mm in depth and 10 mm
/// across.
LesionRow prediction() {
  LesionRow row;
  row.lesion = "L1", row.view = "cc";
  row.detector_u_mm = 30, row.detector_v_mm = 0;
  row.ellipse_major_mm = 20, row.ellipse_minor_mm = 10, row.ellipse_angle_deg = 0;
  row.baseline_u_mm = 33, row.baseline_v_mm = 4;
  return row;
}

TEST_F(RealPairs, MarksAreRead) {
  const std::vector<RealMark> read = marks("L1,cc,219.6,1732.3,0.1,assumed,0\nL2,mlo,3,4,,,\n");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].column_row, Eigen::Vector2d(219.6, 1732.3));
  EXPECT_EQ(read[0].pixel_spacing_mm, 0.1);
  EXPECT_EQ(read[0].edge_column, 0);
  EXPECT_TRUE(read[0].assumed);
  EXPECT_FALSE(read[1].assumed || read[1].pixel_spacing_mm || read[1].edge_column);
}

TEST_F(RealPairs, WhatCannotBeAMarkIsNamed) {
  EXPECT_NE(message_of([&] { marks("L1,lat,1,2,,,\n"); }).find("line 2: view is \"lat\""),
            std::string::npos);
  EXPECT_NE(message_of([&] { marks("L1,cc,1,2,0.1,guessed,\n"); }).find("spacing is \"guessed\""),
            std::string::npos);
  EXPECT_NE(message_of([&] { marks("L1,cc,,2,,,\n"); }).find("column is \"\""), std::string::npos);
  EXPECT_NE(message_of([&] { marks("L1,cc,1,2\n"); }).find("has 4 cells; expected 7"),
            std::string::npos);
}

TEST_F(RealPairs, WithoutAnImageOnlyDepthIsKnown) {
  const std::vector<RealMark> read = marks("L1,cc,250,7,0.1,known,50\nL1,cc,250,7,0.1,known,\n");
  const auto left = placed(read[0], Detector{}, Side::left);
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->u_mm, 20, 1e-12);
  EXPECT_FALSE(left->v_mm);
  EXPECT_NEAR(placed(read[0], Detector{}, Side::right)->u_mm, -20, 1e-12);
  EXPECT_FALSE(placed(read[1], Detector{}, Side::left));  // where is the edge?
  Detector detector;
  detector.pixels = PixelGrid{0.2, 1000, 1201, ImageEdge::left, true};
  const auto whole = placed(read[1], detector, Side::left);
  EXPECT_NEAR(whole->u_mm, 250.5 * 0.2, 1e-12);
  EXPECT_NEAR(whole->v_mm.value(), (600 - 7) * 0.2, 1e-12);
}

// 10 mm off in depth, where an ellipse of 20 mm has a half axis of 11 mm at 50 %; across 9 mm off
// is out of the 50 % one, whose semi-axis there is 5.5 mm.
TEST_F(RealPairs, PlacesAreHeldAgainstEllipses) {
  const json near = judged_mark({}, {40, 0.0}, prediction());
  EXPECT_EQ(near["judged"], "place");
  EXPECT_NEAR(near["error_mm"].get<double>(), 10, 1e-12);
  EXPECT_NEAR(near["baseline_error_mm"].get<double>(), std::hypot(7, 4), 1e-12);
  EXPECT_TRUE(near["in_50"].get<bool>());
  const json aside = judged_mark({}, {30, 9.0}, prediction());
  EXPECT_FALSE(aside["in_50"].get<bool>());
  EXPECT_TRUE(aside["in_90"].get<bool>());
  EXPECT_FALSE(judged_mark({}, {30, 11.0}, prediction())["in_90"].get<bool>());
}

// 90 % of depths alone lie within 1.621 sd, sd being 20 / 2.163 = 9.25: 15.0 mm; half within 5.8.
TEST_F(RealPairs, DepthsAreHeldAgainstTheirOwnInterval) {
  const json row = judged_mark({}, {44.9, std::nullopt}, prediction());
  EXPECT_EQ(row["judged"], "depth");
  EXPECT_NEAR(row["depth_off_mm"].get<double>(), 14.9, 1e-12);
  EXPECT_NEAR(row["baseline_error_mm"].get<double>(), 11.9, 1e-12);
  EXPECT_NEAR(row["reach_90_mm"].get<double>(), 14.99, 0.01);
  EXPECT_TRUE(row["in_90"].get<bool>());
  EXPECT_FALSE(row["in_50"].get<bool>());
  EXPECT_FALSE(judged_mark({}, {45.5, std::nullopt}, prediction())["in_90"].get<bool>());
}

TEST_F(RealPairs, AViewWithoutAnEllipseIsNotJudged) {
  LesionRow row = prediction();
  row.ellipse_major_mm.reset();
  EXPECT_NE(message_of([&] {
              judged_mark({}, {45, 0.0}, row);
            }).find("no ellipse for L1 in cc"),
            std::string::npos);
}

}  // namespace
}  // namespace mammotwin
