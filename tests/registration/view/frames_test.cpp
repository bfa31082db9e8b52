// Walks one point round all frames: voxel, LPS, mesh xi, compressed LPS, view, detector mm, pixel,
// and back along the ray.
#include <gtest/gtest.h>

#include <cmath>

#include "registration/prediction/project_lesions.h"
#include "segmentation/image/volume.h"
#include "tests/registration/squeezed_box.h"

namespace mammotwin {
namespace {

// All maps are affine or one division; 1e-9 mm leaves room for some hundred roundings of 1e2 mm.
constexpr double kRounding_mm = 1e-9;

struct Case {
  Side side;
  double angle_deg;
  ImageEdge edge;
};

class Frames : public testing::TestWithParam<Case> {};

TEST_P(Frames, PointWalksRoundAndComesBack) {
  const auto [side, angle_deg, edge] = GetParam();
  const SqueezedBox breast = squeezed_box(side, angle_deg, 0.5);
  Detector detector;
  detector.support_gap_mm = 15;
  detector.pixels = PixelGrid{0.07, 3328, 4096, edge};
  const ViewProjection projection(breast.prone, breast.compressed, breast.view, detector);

  const Volume<float> mri({200, 150, 100}, {1.02, 1.1, 1.3}, {-100, -80, -60});
  const Eigen::Vector3i voxel(side == Side::left ? 150 : 40, 40, 55);
  const Eigen::Vector3d prone = mri.position(voxel.x(), voxel.y(), voxel.z());
  EXPECT_LT((mri.index(prone) - voxel.cast<double>()).norm(), kRounding_mm);

  const ProjectedLandmark there = projection.project({"lesion", prone});
  EXPECT_EQ(there.outside_mm, 0);
  EXPECT_LT((breast.prone.position(there.point) - prone).norm(), kRounding_mm);
  EXPECT_LT((there.compressed_in_lps - (breast.A * prone + breast.b)).norm(), kRounding_mm);
  const ViewFrame& frame = breast.view.frame;
  EXPECT_LT((frame.lps_from_view(there.in_view) - there.compressed_in_lps).norm(), kRounding_mm);

  const Eigen::Vector2d on_detector = detector.detector_from_image(*there.in_image);
  EXPECT_LT((on_detector - there.on_detector).norm(), kRounding_mm);
  const Eigen::Vector3d in_view = detector.point_on_ray(on_detector, there.in_view.z());
  const PointCarrier prone_from_compressed(breast.compressed, breast.prone);
  const CarriedPoint back = prone_from_compressed.carry(frame.lps_from_view(in_view));
  EXPECT_LT((back.in_lps - prone).norm(), kRounding_mm);
}

INSTANTIATE_TEST_SUITE_P(SidesAndAngles, Frames,
                         testing::Values(Case{Side::left, 0, ImageEdge::left},
                                         Case{Side::right, 0, ImageEdge::right},
                                         Case{Side::left, 45, ImageEdge::left},
                                         Case{Side::right, 45, ImageEdge::right},
                                         Case{Side::left, 90, ImageEdge::right},
                                         Case{Side::right, -30, ImageEdge::left}));

TEST(ViewFrame, CcLooksDownAndLateralIsThePatientsOwnSide) {
  const Eigen::Vector3d left(1, 0, 0), anterior(0, -1, 0), superior(0, 0, 1);
  for (const Side side : {Side::left, Side::right}) {
    const Eigen::Matrix3d axes = view_axes(side, 0);
    EXPECT_EQ(axes.row(0), anterior.transpose());
    EXPECT_EQ(axes.row(1), (side == Side::left ? left : -left).eval().transpose());
    EXPECT_EQ(axes.row(2), superior.transpose());
  }
}

TEST(ViewFrame, MloBeamRunsFromSuperiorMedialToInferiorLateral) {
  for (const Side side : {Side::left, Side::right}) {
    const Eigen::Vector3d beam = -view_axes(side, 45).row(2);
    EXPECT_LT(beam.z(), 0);                                   // downwards
    EXPECT_GT(side == Side::left ? beam.x() : -beam.x(), 0);  // outwards
    const Eigen::Vector3d lateral = view_axes(side, 45).row(1);
    EXPECT_GT(lateral.z(), 0);                                      // upwards
    EXPECT_GT(side == Side::left ? lateral.x() : -lateral.x(), 0);  // outwards
  }
}

TEST(ViewFrame, AxesAreOrthonormalAtEveryAngle) {
  for (double angle = -90; angle <= 90; angle += 7.5) {
    const Eigen::Matrix3d axes = view_axes(Side::right, angle);
    EXPECT_LT((axes * axes.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  }
}

TEST(CompressedView, IsReadFromTheFieldsOfTheMeshFile) {
  const CompressedView made = squeezed_box(Side::right, 45, 0.5).view;
  std::vector<double> axes;
  for (int i = 0; i < 9; ++i) axes.push_back(made.frame.axes(i / 3, i % 3));
  const Eigen::Vector3d& o = made.frame.origin_in_lps;
  std::map<std::string, std::vector<double>> fields = {
      {"view_side", {1}},
      {"view_angle_deg", {45}},
      {"thickness_mm", {made.thickness_mm}},
      {"view_origin_lps_mm", {o.x(), o.y(), o.z()}},
      {"view_swing_mm", {-7}},
      {"view_roll_deg", {3}},
      {"view_slid_mm", {40}},
      {"view_axes", axes}};
  const CompressedView read = compressed_view("mlo", "mlo.vtu", fields);
  EXPECT_EQ(read.frame.axes, made.frame.axes);
  EXPECT_EQ(read.frame.origin_in_lps, o);
  EXPECT_EQ(read.side, Side::right);
  EXPECT_EQ(read.escape.swing_mm, -7);
  EXPECT_EQ(read.escape.roll_deg, 3);
  EXPECT_EQ(read.escape.slid_mm, 40);

  fields["view_angle_deg"] = {40};
  EXPECT_THROW(compressed_view("mlo", "mlo.vtu", fields), std::runtime_error);
  fields.erase("view_axes");
  try {
    compressed_view("mlo", "mlo.vtu", fields);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("mlo.vtu: the field view_axes is missing"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace mammotwin
