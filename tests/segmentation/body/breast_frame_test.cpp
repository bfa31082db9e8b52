#include "segmentation/body/breast_frame.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

/// Two round breasts of 40 mm at x = -70 and 70 mm, z = 0, on a chest whose front is flat but for a
/// ridge of 12 mm above the breasts, from x = -40 to 0 mm.
Volume<std::uint8_t> breasts_below_a_ridge() {
  Volume<std::uint8_t> body({140, 50, 80}, Eigen::Vector3d::Constant(2),
                            Eigen::Vector3d(-139, -49, -79), 0);
  for (int k = 0; k < 80; ++k)
    for (int j = 0; j < 50; ++j)
      for (int i = 0; i < 140; ++i) {
        const Eigen::Vector3d x = body.position(i, j, k);
        const double breast = 40 - std::hypot(std::abs(x.x()) - 70, x.z());
        const bool ridge = x.z() > 55 && x.x() > -40 && x.x() < 0;
        body(i, j, k) = x.y() > -std::max({0.0, breast, ridge ? 12.0 : 0.0});
      }
  return body;
}

TEST(BreastFrame, ValleyLiesAtTheHeightOfTheApices) {
  const BreastFrame frame = find_breast_frame(breasts_below_a_ridge());
  EXPECT_NEAR(frame.left_apex.x(), 70, 2);
  EXPECT_NEAR(frame.right_apex.x(), -70, 2);
  // The skin between the breasts is flat from x = -30 to 30 there; with the ridge in sight, the
  // plateau would be from 0 to 30 only, its middle at 15.
  EXPECT_NEAR(frame.midline_x, 0, 2);
}

}  // namespace
}  // namespace mammotwin
