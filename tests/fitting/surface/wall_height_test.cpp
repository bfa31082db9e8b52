#include "fitting/surface/wall_height.h"

#include <gtest/gtest.h>

#include "tests/fitting/dome.h"

namespace mammotwin {
namespace {

TEST(MuscleFront, IsTheFrontOfTheMuscle) {
  const Segmentation s = dome_breast();
  const MuscleFront wall = find_muscle_front(s.labels, s.region);
  // The dome's muscle begins in the first voxel behind y = 0, whose front face is at −1 or 0.
  EXPECT_NEAR(wall.height(3, 5), 0, 1.001);
  EXPECT_LT(wall.height.slope(3, 5).norm(), 1e-12);
  EXPECT_EQ(wall.labelled.size(), 41u * 43u);
}

/// The dome with muscle within 15 mm of the axis replaced.
Segmentation dome_with_pit(std::uint8_t value, double depth) {
  Segmentation s = dome_breast();
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i) {
        const Eigen::Vector3d x = s.labels.position(i, j, k);
        if (s.labels(i, j, k) != label::muscle || std::hypot(x.x(), x.z()) > 15) continue;
        s.labels(i, j, k) = x.y() < depth ? value : label::air;
      }
  return s;
}

TEST(MuscleFront, BridgesAPitThatDoesNotReachTheBorder) {
  const Segmentation whole = dome_breast(), pit = dome_with_pit(label::air, 0);
  EXPECT_NEAR(find_muscle_front(pit.labels, pit.region).height(0, 0),
              find_muscle_front(whole.labels, whole.region).height(0, 0), 1e-6);
}

/// The labels with left and right exchanged about the middle of their grid.
Volume<std::uint8_t> mirrored(const Volume<std::uint8_t>& labels) {
  Volume<std::uint8_t> result = labels;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i)
        result(i, j, k) = labels(labels.size.x() - 1 - i, j, k);
  return result;
}

TEST(MuscleFront, OfAMirroredBreastIsTheMirrorImage) {
  Segmentation s = dome_with_pit(label::air, 0), image = s;
  for (int k = 8; k < 14; ++k)
    for (int i = 6; i < 26; ++i)
      for (int j = 0; j < s.labels.size.y(); ++j)
        if (s.labels(i, j, k) == label::muscle) s.labels(i, j, k) = label::air;
  image.labels = mirrored(s.labels);
  const double sum =
      s.labels.position(0, 0, 0).x() + s.labels.position(s.labels.size.x() - 1, 0, 0).x();
  image.region.x_min = sum - s.region.x_max;
  image.region.x_max = sum - s.region.x_min;
  const HeightField wall = find_muscle_front(s.labels, s.region).height;
  const HeightField other = find_muscle_front(image.labels, image.region).height;
  for (double x = -36; x <= 36; x += 1.7)
    for (double z = -30; z <= 30; z += 3.3)
      EXPECT_NEAR(wall(x, z), other(sum - x, z), 1e-9) << x << " " << z;
}

TEST(MuscleFront, HoldsALesionThatHasGrownIntoTheMuscle) {
  const Segmentation s = dome_with_pit(label::lesion, 8);
  const HeightField wall = find_muscle_front(s.labels, s.region).height;
  EXPECT_GT(wall(0, 0), 7);  // the last voxel ends at y = 7
  EXPECT_GT(wall(13, 0), 7);
  EXPECT_LT(wall(30, 0), 1.001);
  EXPECT_LT(wall.slope(18, 0).norm(), 1.6);
}

TEST(MuscleFront, TakesTheEndOfTissueWhereTheBorderHasNoMuscle) {
  Segmentation s = dome_breast();
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i)
        if (s.labels(i, j, k) == label::muscle && s.labels.position(i, j, k).x() > 20)
          s.labels(i, j, k) = s.labels.position(i, j, k).y() < 6 ? label::fat : label::air;
  const MuscleFront wall = find_muscle_front(s.labels, s.region);
  EXPECT_NEAR(wall.height(35, 0), 6, 2);
  EXPECT_NEAR(wall.height(-20, 0), 0, 1.001);
}

TEST(MuscleFront, IgnoresSpecksOfMuscle) {
  Segmentation s = dome_breast();
  const double before = find_muscle_front(s.labels, s.region).height(0, 0);
  for (int k = 28; k < 32; ++k)
    for (int i = 18; i < 22; ++i) s.labels(i, 20, k) = label::muscle;
  EXPECT_EQ(find_muscle_front(s.labels, s.region).height(0, 0), before);
}

}  // namespace
}  // namespace mammotwin
