#include "registration/search/edge_prior.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "fitting/mesh/block_mesh.h"
#include "registration/view/breast_middle.h"
#include "registration/view/laid_on_detector.h"

namespace mammotwin {
namespace {

double tan_deg(double degrees) { return std::tan(degrees * M_PI / 180); }

/// A box whose wall recedes by 20 degrees towards lateral, 10 mm behind the plates' edge at the
/// nipple, which stands 50 mm in front of that edge. The view's axes are those of a left CC.
struct SlantedBox {
  MeshFile file{block_mesh({20, -60, -40}, {120, 0, 40}, {4, 1, 2}), {}, {}, {}, {}, {}};
  CompressedView view{"cc", Side::left, 0, 40, {}};
  Eigen::Vector3d nipple{70, -60, 0};

  SlantedBox() {
    std::vector<HermiteMesh::Node> nodes = file.mesh.nodes();
    for (HermiteMesh::Node& node : nodes) {
      node.row(1) += tan_deg(20) * node.row(0);
      node(1, 0) -= tan_deg(20) * 70;
    }
    file.mesh = HermiteMesh(nodes, file.mesh.elements());
    FaceLabels faces;
    faces.fill(FaceLabel::skin);
    faces[3] = FaceLabel::chest_wall;  // y = 0
    file.faces.assign(file.mesh.num_elements(), faces);
    view.frame = {{70, -10, -20}, view_axes(Side::left, 0)};
  }
  void tilt() {
    view.angle_deg = 45;
    view.frame.axes = view_axes(Side::left, 45);
  }
  Eigen::Vector2d nipple_in_view() const { return view.frame.view_from_lps(nipple).head<2>(); }
  /// A point of the detector's plane where the prior's mean puts it.
  static Eigen::Vector2d laid(const Eigen::Vector2d& x, const EdgePrior& prior) {
    return Eigen::Rotation2Dd(prior.mean[kTurn] * M_PI / 180) * x +
           prior.mean.segment<2>(kShiftDepth);
  }
};

TEST(EdgePrior, FindsTheWallsLine) {
  const SlantedBox box;
  const WallLine wall = wall_line(box.file, box.view, box.nipple);
  EXPECT_NEAR(wall.slope_deg, -20, 0.5);  // samples of a band lie up to 2.5 mm off its middle
  EXPECT_NEAR(wall.depth_mm, -10, 0.5);
}

// 14.5 mm, of which the plates' clearance of 4 mm is there already.
TEST(EdgePrior, LeavesItInCcToThePlatesWithinCentimetres) {
  const SlantedBox box;
  const EdgePrior prior = edge_prior(box.file, box.view, box.nipple);
  EXPECT_EQ(prior.mean, ViewState::Zero());
  EXPECT_NEAR(prior.sd[kShiftDepth], std::sqrt(14.5 * 14.5 - 16), 1e-9);
}

TEST(EdgePrior, LaysTheNippleInMloAsDeepAsRealOnesAre) {
  SlantedBox box;
  box.tilt();
  const EdgePrior prior = edge_prior(box.file, box.view, box.nipple);
  const WallLine wall = wall_line(box.file, box.view, box.nipple);
  EXPECT_EQ(prior.mean[kTurn], -25);
  EXPECT_EQ(prior.sd[kTurn], 12);
  const double from_wall =
      (box.nipple_in_view().x() - wall.depth_mm) * std::cos(wall.slope_deg * M_PI / 180);
  EXPECT_NEAR(SlantedBox::laid(box.nipple_in_view(), prior).x(), 0.90 * from_wall, 1e-9);
  EXPECT_NEAR(prior.sd[kShiftDepth], std::sqrt(std::pow(0.12 * from_wall, 2) + 10 * 10 - 4 * 4),
              1e-9);
}

// Two points on the detector, the nipple and one 60 mm higher up: by a turn the depth of the first
// is no less sure, that of the other by 60 mm times the turn.
TEST(EdgePrior, TurnsInMloAboutTheNipple) {
  SlantedBox box;
  box.tilt();
  const EdgePrior prior = edge_prior(box.file, box.view, box.nipple);
  const Eigen::Vector2d nipple = SlantedBox::laid(box.nipple_in_view(), prior);
  const double turn = prior.sd[kTurn] * M_PI / 180, shift = prior.sd[kShiftDepth];
  const auto depth_variance = [&](double lateral) {
    const Eigen::Vector2d slope(-(lateral - prior.mean[kShiftLateral]) * turn, shift);
    const Eigen::Matrix2d c = prior.covariance().block<2, 2>(kTurn, kTurn);
    return slope.dot(c * slope);
  };
  EXPECT_NEAR(depth_variance(nipple.y()), shift * shift, 0.1);
  EXPECT_NEAR(depth_variance(nipple.y() + 60), shift * shift + std::pow(60 * turn, 2), 3);
}

TEST(EdgePrior, LaysTheBreastOnTheDetectorsMiddleHoweverItIsTurned) {
  SlantedBox box;
  box.tilt();
  const EdgePrior prior = edge_prior(box.file, box.view, box.nipple);
  const auto middle = [&](double turns, const Eigen::Vector2d& more_mm) {
    const Eigen::Vector2d shift =
        prior.mean.segment<2>(kShiftDepth) +
        turns * prior.shift_by_turn.cwiseProduct(prior.sd.segment<2>(kShiftDepth)) + more_mm;
    return breast_middle_mm(
        box.file.mesh,
        laid_on_detector(box.view, prior.mean[kTurn] + turns * prior.sd[kTurn], shift).frame);
  };
  EXPECT_NEAR(middle(0, {0, 0}), 0, 1e-9);
  EXPECT_NEAR(middle(0, {0, 12}), 12, 1e-9);
  for (const double turns : {-1.0, 1.0}) EXPECT_NEAR(middle(turns, {0, 0}), 0, 3) << turns;
}

TEST(EdgePrior, NamesAViewWithoutAWallNearTheNipple) {
  SlantedBox box;
  box.view = {"mlo", Side::left, 45, 40, box.view.frame};
  try {
    edge_prior(box.file, box.view, {700, -60, 0});
    FAIL() << "no wall, and nothing was thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("mlo: no chest wall"), std::string::npos);
  }
}

}  // namespace
}  // namespace mammotwin
