#include "pipeline/evaluate/segmentation/mri_changes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

using Grey = Volume<float>;

const Eigen::Vector3d kBall(12, -20, 18);  // [mm, LPS]

/// A bright ball without an edge in grey tissue, behind air.
Grey ball_in_tissue() {
  Grey image({60, 50, 40}, {1.5, 1.4, 2}, {-25, -55, -8});
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        const double square = (image.position(i, j, k) - kBall).squaredNorm() / 36;
        image(i, j, k) = static_cast<float>((j < 8 ? 0 : 100) + 300 * std::exp(-square / 2));
      }
  return image;
}

/// The middle of what is brighter than tissue.
Eigen::Vector3d ball_in(const Grey& image, double tissue) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight = 0;
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i)
        if (const double w = image(i, j, k) - 2 * tissue; w > 0)
          sum += w * image.position(i, j, k), weight += w;
  return sum / weight;
}

ChangedMri changed(const std::string& name, const Grey& image) {
  for (const MriChange& change : mri_changes())
    if (change.name == name) return change.apply(image, Side::left);
  throw std::logic_error(name);
}

TEST(MriChanges, WhatIsSeenLiesWhereTheChangePutsIt) {
  const Grey image = ball_in_tissue();
  for (const MriChange& change : mri_changes()) {
    const ChangedMri after = change.apply(image, Side::left);
    const Eigen::Vector3d expected = after.changed_from_first(kBall);
    EXPECT_NEAR((ball_in(after.image, 115) - expected).norm(), 0, 0.5) << change.name;
    EXPECT_EQ(after.mirrored, change.name == "mirror");
  }
}

TEST(MriChanges, TurnsMoveWhatIsOffTheMiddleAndKeepTheGrid) {
  const Grey image = ball_in_tissue();
  for (const char* name : {"turn_5", "turn_-5", "head_up_5"}) {
    const ChangedMri after = changed(name, image);
    EXPECT_EQ(after.image.size, image.size);
    EXPECT_GT((after.changed_from_first(kBall) - kBall).norm(), 0.5) << name;
  }
  const auto there = changed("turn_5", image), back = changed("turn_-5", image);
  EXPECT_LT((back.changed_from_first(there.changed_from_first(kBall)) - kBall).norm(), 1e-12);
}

TEST(MriChanges, GridsCoverTheSameBody) {
  const Grey image = ball_in_tissue();
  const auto extent = [](const Grey& of) {
    return of.spacing.cwiseProduct(of.size.cast<double>()).eval();
  };
  for (const char* name : {"half_voxel", "voxel_0.8", "voxel_1.3"})
    EXPECT_LT((extent(changed(name, image).image) - extent(image)).cwiseAbs().maxCoeff(), 3)
        << name;
  EXPECT_EQ(changed("cut_12", image).image.size.z(), image.size.z() - 12);
}

TEST(MriChanges, SlicesHoldTheMeanOfWhatTheyCover) {
  const Grey image = ball_in_tissue(), thick = changed("slices_s", image).image;
  EXPECT_EQ(thick.spacing, Eigen::Vector3d(1.5, 1.4, 2.5));
  EXPECT_EQ(thick.size, Eigen::Vector3i(60, 50, 32));
  EXPECT_NEAR(thick(20, 30, 0), (2 * image(20, 30, 0) + 0.5 * image(20, 30, 1)) / 2.5, 1e-3);
}

TEST(MriChanges, AloneLeavesTheBreastAndTheBreastbone) {
  const Grey image = ball_in_tissue();
  for (const MriChange& change : mri_changes()) {
    if (change.name != "alone") continue;
    const Grey left = change.apply(image, Side::left).image,
               right = change.apply(image, Side::right).image;
    EXPECT_EQ(left.size.x(), 41) << "of 60 columns of 1.5 mm all but 19";
    EXPECT_NEAR(left.origin.x(), image.origin.x() + 19 * 1.5, 1e-9);
    EXPECT_EQ(right.origin.x(), image.origin.x());
  }
}

TEST(MriChanges, NoiseHasTheSizeThatIsSaid) {
  const Grey image = ball_in_tissue(), noisy = changed("noise_3", image).image;
  double sum = 0;
  int count = 0;
  for (std::size_t v = 0; v < image.values.size(); ++v)
    if (image.values[v] > 50) sum += std::pow(noisy.values[v] - image.values[v], 2), ++count;
  EXPECT_NEAR(std::sqrt(sum / count), 3, 0.5);  // tissue is 100 and a little
}

TEST(MriChanges, ShadingFallsFromOneEndToTheOther) {
  const Grey image = ball_in_tissue(), shaded = changed("shaded_l", image).image;
  const auto factor = [&](int i) { return shaded(i, 40, 5) / image(i, 40, 5); };
  EXPECT_NEAR(factor(0), 1.25, 0.01);
  EXPECT_NEAR(factor(59), 0.75, 0.01);
}

}  // namespace
}  // namespace mammotwin
