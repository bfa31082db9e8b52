#include "segmentation/contrast_agent/pre_match.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mammotwin {
namespace {

constexpr float noise = 0.08F;

/// Lumps of gland (1.8) in fat (1), moved by so much [mm]; voxels of 1.2 mm, with noise.
Volume<float> lumps(const Eigen::Vector3d& moved, unsigned seed) {
  Volume<float> image({60, 60, 60}, Eigen::Vector3d::Constant(1.2), Eigen::Vector3d::Zero(), 0);
  std::mt19937 random(seed);
  std::normal_distribution<float> gauss(0, noise);
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i) {
        const Eigen::Vector3d x = image.position(i, j, k) - moved;
        const double wave =
            std::sin(0.33 * x.x()) * std::sin(0.29 * x.y()) * std::sin(0.31 * x.z());
        image(i, j, k) =
            static_cast<float>(1 + 0.8 / (1 + std::exp(-12 * (wave - 0.3)))) + gauss(random);
      }
  return image;
}

PreMatch matched(const Volume<float>& post, const Volume<float>& pre) {
  return match_pre(post, pre, post.like<float>(noise), post.like<std::uint8_t>(1));
}

TEST(PreMatch, TellsADisplacementWithoutLookingAtGain) {
  for (const double moved : {0.0, 0.5, 1.5}) {
    Volume<float> post = lumps({0, 0, 0}, 1);
    for (float& value : post.values) value *= 1.5F;
    const PreMatch match = matched(post, lumps({0.6 * moved, 0, -0.8 * moved}, 2));
    EXPECT_NEAR(match.scale, 1.5, 0.01);
    ASSERT_TRUE(match.shift_mm);
    EXPECT_NEAR(*match.shift_mm, moved, 0.15 + 0.1 * moved);
  }
}

TEST(PreMatch, WhatTakesUpContrastAgentIsNoMovement) {
  Volume<float> post = lumps({0, 0, 0}, 1);
  for (int k = 20; k < 30; ++k)
    for (int j = 20; j < 30; ++j)
      for (int i = 20; i < 30; ++i) post(i, j, k) *= 2;
  EXPECT_LT(*matched(post, lumps({0, 0, 0}, 2)).shift_mm, 0.3);
}

TEST(PreMatch, ImagesWithoutAnEdgeTellNothing) {
  Volume<float> flat({30, 30, 30}, Eigen::Vector3d::Constant(1.2), Eigen::Vector3d::Zero(), 1);
  EXPECT_FALSE(matched(flat, flat).shift_mm);
}

}  // namespace
}  // namespace mammotwin
