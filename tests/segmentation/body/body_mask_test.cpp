#include "segmentation/body/body_mask.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

constexpr int skin_begins = 20, skin_voxels = 2;  // slices of 1 mm
constexpr double share = 0.3;

struct BodyWithSkin {
  Volume<float> image;
  Volume<std::uint8_t> body;
};

/// A flat fat-suppressed body over 20 slices of air: skin 2, fat `fat`; in the middle of the air 8
/// slices of ghost of brightness `ghost` hang on it, which the mask takes for body.
BodyWithSkin body_with_ghost(float fat, float ghost) {
  BodyWithSkin scene{
      Volume<float>({40, 40, 50}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0), {}};
  scene.body = scene.image.like<std::uint8_t>(0);
  for (int k = 0; k < 50; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) {
        const bool in_ghost = k >= skin_begins - 8 && i > 10 && i < 30 && j > 10 && j < 30;
        const bool tissue = k >= skin_begins;
        scene.image(i, j, k) = k >= skin_begins + skin_voxels ? fat
                               : tissue                       ? 2.0F
                               : in_ghost                     ? ghost
                                                              : 0.02F;
        scene.body(i, j, k) = tissue || in_ghost;
      }
  return scene;
}

TEST(BodyMask, AGhostThatHangsOnTheBodyIsCutOffToTheSkin) {
  const BodyWithSkin scene = body_with_ghost(1, 0.1F);
  const auto without_ghost = cut_ghosts(scene.image, scene.body, share);
  // What is left of it shines by the skin's blur, and belongs to the rim.
  for (int k = 0; k < skin_begins - 3; ++k) EXPECT_EQ(without_ghost(20, 20, k), 0) << k;
  const auto cut = cut_rim(scene.image, without_ghost, 0.45);
  for (int k = 0; k < 50; ++k) EXPECT_EQ(cut(20, 20, k), k >= skin_begins) << k;
}

/// Is a voxel of 1 mm in a ball?
bool in_ball(int i, int j, int k, const Eigen::Vector3d& centre, double radius) {
  return (Eigen::Vector3d(i, j, k) - centre).norm() <= radius;
}

// A body with a nipple, 9 mm high and wide, and beside it tissue of 16 mm that the scanner wrapped
// there and that hangs on it by a thread of 3 mm.
TEST(BodyMask, WrappedTissueThatHangsByAThreadIsNoBodyAndANippleIs) {
  Volume<std::uint8_t> tissue({70, 40, 60}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0);
  const Volume<std::uint8_t> empty = tissue;
  Volume<std::uint8_t> all = tissue;
  const auto thread = [](int i, int j, int k) {
    return std::abs(i - 50) <= 1 && std::abs(j - 20) <= 1 && k > 20 && k < 40;
  };
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 70; ++i) {
        tissue(i, j, k) = k >= 40 || in_ball(i, j, k, {15, 20, 36}, 4.5) ||
                          (k >= 36 && std::hypot(i - 15, j - 20) <= 4.5);
        all(i, j, k) = tissue(i, j, k) || thread(i, j, k) || in_ball(i, j, k, {50, 20, 14}, 8);
      }
  EXPECT_EQ(cut_islands(tissue).values, tissue.values);
  const Volume<std::uint8_t> cut = cut_islands(all);
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 70; ++i) {
        const bool at_its_root = k >= 37 && thread(i, j, k);
        if (!at_its_root) {
          EXPECT_EQ(cut(i, j, k), tissue(i, j, k)) << i << " " << j << " " << k;
        }
      }
  EXPECT_EQ(cut_islands(empty).values, empty.values);
}

/// A body of fat 1 in haze of 0.03 beside it, in slices of hardly any noise, as resampling leaves:
/// half of the slice is haze, which passes 6 times the noise.
TEST(BodyMask, HazeInTheAirIsNoBodyWhereNoiseIsLow) {
  Volume<float> image({60, 60, 12}, Eigen::Vector3d::Constant(2), Eigen::Vector3d::Zero(), 0.001F);
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i)
        image(i, j, k) = j >= 40 ? (j >= 45 ? 0.3F : 1.0F) : i >= 10 ? 0.03F : 0.001F;
  const Volume<std::uint8_t> body = coarse_body(image, 0.001);
  EXPECT_EQ(body(40, 20, 6), 0);
  EXPECT_EQ(body(40, 50, 6), 1);
}

TEST(BodyMask, DarkFatBehindSkinIsNoGhost) {
  // Fat a tenth as bright as skin, as where suppression works well: skin keeps it.
  const BodyWithSkin scene = body_with_ghost(0.2F, 0.02F);
  const auto cut = cut_ghosts(scene.image, scene.body, share);
  for (int k = skin_begins; k < 50; ++k) EXPECT_EQ(cut(20, 20, k), 1) << k;
}

}  // namespace
}  // namespace mammotwin
