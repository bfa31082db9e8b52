#include "registration/view/plate_escape.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "fitting/mesh/block_mesh.h"

namespace mammotwin {
namespace {

HermiteMesh mapped(const HermiteMesh& mesh, const Eigen::Matrix3d& map, const Eigen::Vector3d& by) {
  std::vector<HermiteMesh::Node> nodes = mesh.nodes();
  for (HermiteMesh::Node& node : nodes) {
    node = (map * node).eval();
    node.col(0) += by;
  }
  return {nodes, mesh.elements()};
}

const HermiteMesh kBlock = block_mesh({-40, -60, -30}, {40, 0, 30}, {2, 2, 2});
const MeshPoint kFront{4, {0.5, 0, 0.5}};

ViewFrame cc() { return {{0, 100, 0}, view_axes(Side::left, 0)}; }

// Flattening along the beam with spreading across it is no roll, however strong.
TEST(PlateEscape, IsNoneOfASpread) {
  const Eigen::Matrix3d spread = Eigen::Vector3d(1.5, 1.3, 0.5).asDiagonal();
  const auto escape = plate_escape(kBlock, mapped(kBlock, spread, {0, 0, 7}), kFront, cc());
  EXPECT_NEAR(escape.roll_deg, 0, 1e-5);
}

// Turned by 25 degrees about depth and carried on so that the nipple moves 12 mm to the left.
TEST(PlateEscape, IsTheTurnAndTheNipplesMoveAlongTheEdges) {
  const Eigen::Matrix3d turn(
      Eigen::AngleAxisd(25 * std::numbers::pi / 180, Eigen::Vector3d::UnitY()));
  const HermiteMesh moved = mapped(kBlock, turn, {0, 0, 0});
  const Eigen::Vector3d by = Eigen::Vector3d(12, 3, 5) - moved.position(kFront) +
                             kBlock.position(kFront);  // the nipple moves by just this
  const auto escape = plate_escape(kBlock, mapped(kBlock, turn, by), kFront, cc());
  EXPECT_NEAR(escape.roll_deg, 25, 1e-9);
  EXPECT_NEAR(escape.swing_mm, 12, 1e-9);
}

// The edges lie at y = 100 and the whole block before them; depth points to -y.
TEST(PlateEscape, IsHowFarTissueSlidBackAndNothingWhereItGoesForward) {
  const auto slid = [](double by) {
    return plate_escape(kBlock, mapped(kBlock, Eigen::Matrix3d::Identity(), {0, by, 0}), kFront,
                        cc())
        .slid_mm;
  };
  EXPECT_NEAR(slid(30), 30, 1e-9);
  EXPECT_EQ(slid(-5), 0);
}

// What lies behind the plates' edges does not count: here all that turns.
TEST(PlateEscape, LeavesOutWhatIsBehindTheEdges) {
  ViewFrame far = cc();
  far.origin_in_lps = {0, -200, 0};
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()));
  EXPECT_EQ(plate_escape(kBlock, mapped(kBlock, turn, {0, 0, 0}), kFront, far).roll_deg, 0);
}

}  // namespace
}  // namespace mammotwin
