#include "segmentation/contrast_agent/enhancement.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mammotwin {
namespace {

TEST(Enhancement, IsRelativeAndOnTheGridOfTheLaterImage) {
  Volume<float> pre({10, 10, 10}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 2);
  Volume<float> post({5, 5, 5}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(2.5), 3);
  post(1, 1, 1) = 1;
  pre(9, 9, 9) = 100;
  const Volume<float> seen = on_grid_of(post, pre);
  EXPECT_EQ(seen.size, post.size);
  const Volume<float> enhancement = relative_enhancement(post, seen, 0.1);
  EXPECT_FLOAT_EQ(enhancement(0, 0, 0), 0.5F);
  EXPECT_EQ(enhancement(1, 1, 1), 0) << "what lost brightness took up nothing";
}

TEST(Enhancement, AnImageOfAnotherPlaceIsRefused) {
  const Volume<float> post({40, 30, 30}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 1);
  Volume<float> pre = post;
  pre.origin.x() += 20;
  EXPECT_THROW(on_grid_of(post, pre), std::runtime_error);
}

}  // namespace
}  // namespace mammotwin
