#include "segmentation/chest_wall/wall_stage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/segmentation/phantom.h"

namespace mammotwin {
namespace {

constexpr double stiffness = 0.08;

/// The outline of a phantom without fat suppression, after contrast agent.
BodyStage body_with(double noise) {
  Phantom phantom;
  phantom.fat_suppressed = false;
  phantom.contrast_agent = true;
  phantom.noise = noise;
  SegmentQuality quality;
  return find_body(phantom.image(), false, quality);
}

/// The image before contrast agent, with little noise, moved by so many voxels to the front.
Volume<float> image_before(const BodyStage& body, int moved) {
  Phantom phantom;
  phantom.fat_suppressed = false;
  const Volume<float> whole = phantom.image();
  auto pre = body.image.like<float>(0);
  for (int k = 0; k < pre.size.z(); ++k)
    for (int j = 0; j < pre.size.y(); ++j)
      for (int i = 0; i < pre.size.x(); ++i) {
        const Eigen::Vector3i v =
            whole.index(pre.position(i, j, k)).array().round().cast<int>().matrix();
        pre(i, j, k) = whole(v.x(), std::min(v.y() + moved, whole.size.y() - 1), v.z());
      }
  return pre;
}

/// Mean distance of the wall from the front of muscle, within 40 degrees, in the breasts' slices.
double wall_error(const BodyStage& body, const PectoralWall& wall) {
  double sum = 0;
  int rays = 0;
  for (std::size_t n = 0; n < wall.radius.size(); ++n) {
    const Eigen::Vector3d x = wall.position(n, wall.radius[n]);
    const double angle = std::atan2(x.x() - wall.axis_x, wall.axis_y - x.y());
    if (std::abs(angle) > 0.7 || x.z() < body.frame.z_low || x.z() > body.frame.z_high) continue;
    sum += std::abs(Phantom().before_wall(x)), ++rays;
  }
  return sum / rays;
}

TEST(WallStage, IsFoundInBothImagesIfThePatientLayStill) {
  const BodyStage body = body_with(0.3);
  const WallStage alone = find_wall(body, {}, Side::left, stiffness);
  EXPECT_FALSE(alone.pre_match);
  const WallStage both = find_wall(body, {image_before(body, 0), {}}, Side::left, stiffness);
  ASSERT_TRUE(both.pre_match && !both.pre_match->moved());
  EXPECT_LT(wall_error(body, both.found.wall), 0.75 * wall_error(body, alone.found.wall));
}

TEST(WallStage, IsThatOfTheLaterImageIfThePatientMoved) {
  const BodyStage body = body_with(0.05);
  const WallStage alone = find_wall(body, {}, Side::left, stiffness);
  const WallStage moved = find_wall(body, {image_before(body, 1), {}}, Side::left, stiffness);
  ASSERT_TRUE(moved.pre_match && moved.pre_match->moved());
  EXPECT_EQ(moved.found.wall.radius, alone.found.wall.radius);
}

}  // namespace
}  // namespace mammotwin
