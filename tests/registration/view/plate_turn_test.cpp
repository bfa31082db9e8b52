#include "registration/view/plate_turn.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fitting/mesh/block_mesh.h"
#include "fitting/mesh/inverse_map.h"
#include "registration/view/compressed_view.h"

namespace mammotwin {
namespace {

/// A box of 100 mm whose chest wall, y = slope s + bend s^2, recedes laterally (s grows from the
/// middle, x = 70 mm, towards the patient's side).
MeshFile box(Side side, double slope, double bend, const Eigen::Vector3i& elements = {8, 2, 8}) {
  const double sign = side == Side::left ? 1 : -1;
  const double low = side == Side::left ? 20 : -120;
  MeshFile file{block_mesh({low, -60, -50}, {low + 100, 0, 50}, elements), {}, {}, {}, {}, {}};
  std::vector<HermiteMesh::Node> nodes = file.mesh.nodes();
  const double step = 100.0 / elements.x();  // of x along the first coordinate of an element
  for (HermiteMesh::Node& node : nodes) {
    const double s = sign * node(0, 0) - 70;
    node(1, 0) += slope * s + bend * s * s;
    node(1, 1) += sign * (slope + 2 * bend * s) * step;
  }
  file.mesh = HermiteMesh(nodes, file.mesh.elements());
  FaceLabels faces;
  faces.fill(FaceLabel::skin);
  faces[3] = FaceLabel::chest_wall;  // y = 0
  FaceLabels inner = faces;
  inner[3] = FaceLabel::interior;
  for (int e = 0; e < file.mesh.num_elements(); ++e)
    file.faces.push_back(e / elements.x() % elements.y() == elements.y() - 1 ? faces : inner);
  return file;
}

/// On the skin, so far laterally of the box's middle.
MeshPoint nipple(const MeshFile& mesh, Side side, double aside_mm) {
  const double sign = side == Side::left ? 1 : -1;
  MeshPoint tip = InverseMap(mesh.mesh).nearest({sign * (70 + aside_mm), -60, 0});
  tip.xi.x() +=
      (sign * (70 + aside_mm) - mesh.mesh.position(tip).x()) / mesh.mesh.jacobian(tip)(0, 0);
  tip.xi.y() = 0;
  return tip;
}

double cc_turn(const MeshFile& mesh, Side side, double aside_mm = 0) {
  return straight_turn_deg(mesh, nipple(mesh, side, aside_mm), view_axes(side, 0));
}

double degrees(double tangent) { return std::atan(tangent) * 180 / M_PI; }

// The wall is turned by 20 degrees, the nipple stands 60 mm before the wall's middle.
TEST(PlateTurn, IsHalfWayFromTheBreastsAxisToTheWallsNormalOnEitherSide) {
  const double slope = std::tan(20 * M_PI / 180);
  for (const Side side : {Side::left, Side::right}) {
    const MeshFile slanted = box(side, slope, 0);
    EXPECT_NEAR(cc_turn(slanted, side), -10, 1e-6);
    EXPECT_NEAR(cc_turn(slanted, side, 15), -(20 + degrees(15 / (60 - 15 * slope))) / 2, 0.01);
  }
}

TEST(PlateTurn, OfACurvedWallCountsWhatLiesBehindTheNipple) {
  const MeshFile curved = box(Side::left, 0, 0.003);  // 17 degrees at its ends
  EXPECT_NEAR(cc_turn(curved, Side::left), 0, 1e-6);
  const auto of_wall = [&](double aside) {
    const Eigen::Vector3d tip = curved.mesh.position(nipple(curved, Side::left, aside));
    constexpr double kMeanOfWall_mm = 0.003 * 100 * 100 / 12;
    return 2 * cc_turn(curved, Side::left, aside) +
           degrees((tip.x() - 70) / (kMeanOfWall_mm - tip.y()));
  };
  // 6.8 degrees 20 mm from the middle; what lies nearer to the middle counts, too.
  EXPECT_LT(of_wall(20), -1);
  EXPECT_GT(of_wall(20), -6.8);
  EXPECT_NEAR(of_wall(-20), -of_wall(20), 0.05);
}

TEST(PlateTurn, HangsOnNoMesh) {
  const double turn = cc_turn(box(Side::left, 0.2, 0.002, {5, 2, 5}), Side::left, 15);
  EXPECT_NEAR(turn, cc_turn(box(Side::left, 0.2, 0.002, {11, 2, 9}), Side::left, 15), 0.05);
}

TEST(PlateTurn, TurnsWithTheBody) {
  const MeshFile mesh = box(Side::left, 0.2, 0.002);
  const MeshPoint tip = nipple(mesh, Side::left, 15);
  const Eigen::Matrix3d turned = axes_of(Side::left, 0, 5);
  EXPECT_NEAR(straight_turn_deg(mesh, tip, turned),
              straight_turn_deg(mesh, tip, view_axes(Side::left, 0)) - 5, 1e-9);
}

// A wall that recedes to the side does so by less along an oblique view's lateral axis, which goes
// half up.
TEST(PlateTurn, LetsBreastsComeOutStraightInObliqueViewsToo) {
  const MeshFile mesh = box(Side::left, 0.3, 0);
  const MeshPoint tip = nipple(mesh, Side::left, 0);
  EXPECT_EQ(usual_turn_deg(mesh, tip, Side::left, 0), cc_turn(mesh, Side::left));
  EXPECT_NEAR(usual_turn_deg(mesh, tip, Side::left, 45),
              straight_turn_deg(mesh, tip, view_axes(Side::left, 45)), 1e-12);
  EXPECT_NEAR(usual_turn_deg(mesh, tip, Side::left, 45), -degrees(0.3 * std::cos(M_PI / 4)) / 2, 1);
}

TEST(PlateTurn, WithoutAWallThereIsNothingToStandBy) {
  MeshFile mesh = box(Side::left, 0, 0);
  for (FaceLabels& faces : mesh.faces) faces.fill(FaceLabel::skin);
  EXPECT_THROW(cc_turn(mesh, Side::left), std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin
