#include "segmentation/files/grid_image.h"

#include <Eigen/Geometry>

#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

/// A field that is linear in LPS position, so that a value says where it stands.
double field(const Eigen::Vector3d& x) { return 3 * x.x() + 5 * x.y() - 2 * x.z() + 700; }

GridImage sampled(const Eigen::Matrix3d& direction) {
  GridImage image;
  image.size = {6, 7, 8};
  image.spacing = {1.5, 1.0, 2.0};
  image.origin = {-20, 10, 30};
  image.direction = direction;
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        const Eigen::Vector3d step = image.spacing.cwiseProduct(Eigen::Vector3d(i, j, k));
        image.values.push_back(static_cast<float>(field(image.origin + image.direction * step)));
      }
  return image;
}

TEST(GridImage, EveryVoxelKeepsItsPlaceInAll48Orientations) {
  int orientations = 0;
  std::array<int, 3> axes{0, 1, 2};
  do {
    for (int flips = 0; flips < 8; ++flips, ++orientations) {
      Eigen::Matrix3d direction = Eigen::Matrix3d::Zero();
      for (int a = 0; a < 3; ++a) direction(axes[a], a) = (flips >> a) & 1 ? -1 : 1;
      std::vector<std::string> notes;
      const Volume<float> out = to_lps_grid(sampled(direction), Between::linear, notes);
      ASSERT_TRUE(notes.empty());
      ASSERT_EQ(out.values.size(), 6U * 7 * 8);
      for (int k = 0; k < out.size.z(); ++k)
        for (int j = 0; j < out.size.y(); ++j)
          for (int i = 0; i < out.size.x(); ++i)  // floats near 1000 resolve 6e-5
            ASSERT_NEAR(out(i, j, k), field(out.position(i, j, k)), 1e-3);
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  EXPECT_EQ(orientations, 48);
}

TEST(GridImage, ObliqueImageIsResampledAndSaysSo) {
  const Eigen::Matrix3d direction =
      Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()).toRotationMatrix();  // 11.5 degrees
  const GridImage image = sampled(direction);
  std::vector<std::string> notes;
  const Volume<float> out = to_lps_grid(image, Between::linear, notes);
  ASSERT_EQ(notes.size(), 1U);
  expect_mentions(notes[0], {"oblique by 11.5 degrees"});
  // A linear field survives linear interpolation, inside; outside is 0.
  const Eigen::Vector3d centre =
      image.origin +
      image.direction *
          ((image.size.array() - 1).cast<double>() / 2 * image.spacing.array()).matrix();
  const Eigen::Vector3i c = out.index(centre).array().round().cast<int>();
  EXPECT_NEAR(out(c.x(), c.y(), c.z()), field(out.position(c.x(), c.y(), c.z())), 1e-3);
  EXPECT_EQ(out(0, 0, 0), 0);
}

TEST(GridImage, RefusesAxesThatAreNotPerpendicular) {
  Eigen::Matrix3d direction = Eigen::Matrix3d::Identity();
  direction.col(1) = Eigen::Vector3d(0.3, 1, 0).normalized();
  std::vector<std::string> notes;
  expect_mentions(message_of([&] { to_lps_grid(sampled(direction), Between::linear, notes); }),
                  {"not perpendicular"});
}

}  // namespace
}  // namespace mammotwin
