#include "pipeline/evaluate/compression/changed_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

using LabelVolume = Volume<std::uint16_t>;

const InputChange& change(const std::string& name) {
  const auto& all = input_changes();
  return *std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
}

/// Label 2 in a box that is nowhere symmetric and reaches a corner of the grid, label 1 about it.
LabelVolume box() {
  LabelVolume labels({30, 24, 20}, {1, 1.5, 2}, {-7, 3, 11}, 1);
  for (int k = 8; k < 20; ++k)
    for (int j = 10; j < 24; ++j)
      for (int i = 5; i < 30; ++i) labels(i, j, k) = 2;
  return labels;
}

bool on_a_boundary(const LabelVolume& labels, int i, int j, int k) {
  for (int n = 0; n < 27; ++n) {
    const int a = i + n % 3 - 1, b = j + n / 3 % 3 - 1, c = k + n / 9 - 1;
    const int other = labels.contains(a, b, c) ? labels(a, b, c) : 0;
    if (other != labels(i, j, k)) return true;
  }
  return false;
}

TEST(ChangedImage, TurnedAndBackDifferAtBoundariesOnly) {
  const LabelVolume before = box(), after = changed_image(before, change("turn_5"));
  int moved = 0;
  for (int k = 0; k < before.size.z(); ++k)
    for (int j = 0; j < before.size.y(); ++j)
      for (int i = 0; i < before.size.x(); ++i) {
        if (after(i, j, k) == before(i, j, k)) continue;
        ++moved;
        EXPECT_TRUE(on_a_boundary(before, i, j, k)) << i << ' ' << j << ' ' << k;
      }
  EXPECT_GT(moved, 0);
}

TEST(ChangedImage, AMirroredMapShowsTheOtherSideOfItsPlane) {
  const LabelVolume before = box(), after = changed_image(before, change("mirror"));
  const double plane = mirror_plane(before);
  const auto at = [](const LabelVolume& labels, double x) {
    return labels(static_cast<int>(std::lround(labels.index({x, 0, 0}).x())), 12, 10);
  };
  for (double x = -7; x <= 22; x += 1) EXPECT_EQ(at(after, x), at(before, 2 * plane - x)) << x;
}

// Between equal voxels the label stays; the grid's places are halfway between the old ones.
TEST(ChangedImage, HalfAVoxelOffKeepsPlacesInSpace) {
  const LabelVolume before = box(), after = changed_image(before, change("half_voxel"));
  EXPECT_EQ(after.position(0, 0, 0), Eigen::Vector3d(-6.5, 3.75, 12));
  EXPECT_EQ(after.size, before.size - Eigen::Vector3i::Ones());
  EXPECT_EQ(after(20, 20, 15), 2);
  EXPECT_EQ(after(3, 20, 15), 1);
  EXPECT_EQ(after(4, 9, 7), 1);   // one of its eight corners in the box
  EXPECT_EQ(after(5, 10, 8), 2);  // all eight
}

/// A blob that is smooth on the scale of a voxel, nowhere near the grid's faces.
double brightness(const Eigen::Vector3d& x) {
  return 100 * std::exp(-(x - Eigen::Vector3d(8, 20, 30)).squaredNorm() / 72);
}

Volume<float> blob() {
  Volume<float> image({40, 32, 24}, {1, 1.5, 2}, {-10, -4, 8});
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i)
        image(i, j, k) = static_cast<float>(brightness(image.position(i, j, k)));
  return image;
}

double largest_error(const Volume<float>& image) {
  double largest = 0;
  for (int k = 1; k < image.size.z() - 1; ++k)
    for (int j = 1; j < image.size.y() - 1; ++j)
      for (int i = 1; i < image.size.x() - 1; ++i)
        largest = std::max(largest, std::abs(image(i, j, k) - brightness(image.position(i, j, k))));
  return largest;
}

// Trilinear weights would flatten its top by the curvature: by 2.5 of 100 half a voxel off.
TEST(ChangedImage, GreyValuesAreThoseOfASplineThroughTheVoxels) {
  EXPECT_LT(largest_error(changed_image(blob(), change("turn_5"))), 0.3);
  EXPECT_LT(largest_error(changed_image(blob(), change("half_voxel"))), 0.3);
}

}  // namespace
}  // namespace mammotwin
