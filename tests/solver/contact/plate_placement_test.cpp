#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

PlateOptions options() {
  PlateOptions o;
  o.thickness = 60;
  return o;
}

const MeshFile& breast() {
  static const MeshFile mesh = dome_breast({4, 4, 2});
  return mesh;
}

std::string refusal(const PlateOptions& o) {
  try {
    PlateFrame(breast(), o);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(PlateFrame, PositiveTiltLowersThePaddlesFront) {
  const PlateFrame frame(breast(), options());
  const PlacedPlates placed = frame.place(-30, 30, 5);
  const Plate& paddle = placed.paddle;
  EXPECT_NEAR(paddle.point.z(), 30, 1e-12);
  const Eigen::Vector3d front = paddle.from_local({100, 0, 0});
  EXPECT_NEAR(front.z(), 30 - 100 * std::sin(5 * std::numbers::pi / 180), 1e-9);
  EXPECT_NEAR(paddle.normal.dot(paddle.depth), 0, 1e-12);
  EXPECT_LT(paddle.normal.z(), 0);
  EXPECT_EQ(placed.support.normal, options().up);
}

TEST(PlateFrame, ATiltedPaddleStartsWhereItTouches) {
  PlateOptions o = options();
  o.paddle_tilt = 8;
  const PlateFrame frame(breast(), o);
  const auto [low, high] = frame.touching_heights();
  double least[2];
  for (int k = 0; k < 2; ++k) {
    const Plate paddle = frame.place(low, high - 0.01 * k, 8).paddle;
    least[k] = 1e9;
    const auto& mesh = breast().mesh;
    for (int e = 0; e < mesh.num_elements(); ++e)
      for (int s = 0; s <= 40; ++s)
        for (int r = 0; r <= 40; ++r) {
          const Eigen::Vector3d x = mesh.position({e, {s / 40.0, r / 40.0, 1.0}});
          if (o.depth.dot(x) >= frame.edge()) least[k] = std::min(least[k], paddle.gap(x).gap);
        }
  }
  // Skin is sampled every 4.4 mm there and every 0.9 mm here; it meets the edge's 10 mm rounding,
  // so 4.4²/(8·10) = 0.24 mm may be missed.
  EXPECT_LE(least[0], 0.01);
  EXPECT_GE(least[0], -0.25);
  EXPECT_LT(least[1], least[0]);
}

TEST(PlateFrame, MeasuresOnlyWhatTheFlatPartsCover) {
  PlateOptions narrow = options();
  narrow.width = 60;
  narrow.length = 40;
  const PlateFrame whole(breast(), options()), part(breast(), narrow);
  EXPECT_LE(part.extent(breast().mesh.nodes()), whole.extent(breast().mesh.nodes()));
  EXPECT_GT(part.extent(breast().mesh.nodes()), 0);
}

TEST(PlateFrame, RefusesShapesThatAreNone) {
  PlateOptions o = options();
  o.width = 15;
  EXPECT_NE(refusal(o).find("width"), std::string::npos);
  o = options();
  o.length = -1;
  EXPECT_NE(refusal(o).find("length"), std::string::npos);
  o = options();
  o.paddle_tilt = 45;
  EXPECT_NE(refusal(o).find("tilt is 45"), std::string::npos);
  o = options();
  o.tilt_spring = 0;
  EXPECT_NE(refusal(o).find("spring"), std::string::npos);
}

// A block 40 mm deep on a plane wall: all of it but the plates' clearance.
TEST(PlateFrame, MeasuresTheVolumeInFrontOfThePlatesEdge) {
  MeshFile block = dome_breast({2, 2, 4});
  block.mesh = mapped_mesh({2, 2, 4}, [](const Eigen::Vector3d& xi) {
    return Eigen::Vector3d(100 * xi.x(), -40 * xi.z(), 80 * xi.y());
  });
  PlateOptions o = options();
  o.wall_clearance = 15;
  EXPECT_NEAR(PlateFrame(block, o).volume_in_front(), 100 * 80 * 25, 1e-6);
}

}  // namespace
}  // namespace mammotwin
