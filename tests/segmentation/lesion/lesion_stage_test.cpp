#include "segmentation/lesion/lesion_stage.h"

#include <gtest/gtest.h>

#include <random>

namespace mammotwin {
namespace {

constexpr int side_voxels = 60;

/// Fat of 1 with balls of 3, noise of 3 %.
struct BallsInFat {
  std::vector<Eigen::Vector3d> centres;
  double radius_mm;
  HalfBreast half;
  HalfImages images;

  BallsInFat(std::vector<Eigen::Vector3d> at, double radius) : centres(at), radius_mm(radius) {
    const Volume<float> grid({side_voxels, side_voxels, side_voxels}, Eigen::Vector3d::Ones(),
                             {0, 0, 0}, 1);
    half.body = half.inside = grid.like<std::uint8_t>(1);
    half.depth = half.above_wall = grid.like<float>(20);
    std::mt19937 random(11);
    std::normal_distribution<float> noise(0, 0.03F);
    images.denoised = grid;
    for (int k = 0; k < side_voxels; ++k)
      for (int j = 0; j < side_voxels; ++j)
        for (int i = 0; i < side_voxels; ++i)
          images.denoised(i, j, k) =
              (holding(grid.position(i, j, k)) >= 0 ? 3.0F : 1.0F) + noise(random);
    images.noisy = images.denoised;
    images.noise = grid.like<float>(0.03F);
  }

  /// The ball that holds a point and is nearest; -1: none.
  int holding(const Eigen::Vector3d& x) const {
    int ball = -1;
    double least = radius_mm;
    for (std::size_t n = 0; n < centres.size(); ++n)
      if (const double away = (x - centres[n]).norm(); away < least)
        least = away, ball = static_cast<int>(n);
    return ball;
  }

  Volume<std::uint8_t> found() const {
    std::vector<PlacedSeed> seeds;
    for (const Eigen::Vector3d& c : centres)
      seeds.push_back({"L" + std::to_string(seeds.size() + 1), c, {}, {}});
    SegmentQuality quality;
    return find_lesions(half, images, seeds, true, {}, quality);
  }
};

Eigen::Vector3d centroid(const Volume<std::uint8_t>& lesions, std::uint8_t value) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (int k = 0; k < side_voxels; ++k)
    for (int j = 0; j < side_voxels; ++j)
      for (int i = 0; i < side_voxels; ++i)
        if (lesions(i, j, k) == value) sum += lesions.position(i, j, k), ++count;
  return sum / count;  // not a number where there is none
}

void expect_both(double radius_mm) {
  const BallsInFat scene({{26.6, 30, 30}, {33.4, 30, 30}}, radius_mm);  // 6.8 mm apart
  const Volume<std::uint8_t> lesions = scene.found();
  for (int n = 0; n < 2; ++n) {
    const auto value = static_cast<std::uint8_t>(label::lesion + n);
    EXPECT_LT((centroid(lesions, value) - scene.centres[n]).norm(), 1) << radius_mm << " mm, " << n;
  }
}

TEST(LesionStage, KeepsTwoLesionsOfWhichEachHasItsPoint) {
  expect_both(2.8);  // 1.2 mm of fat between them
  expect_both(4);    // grown together
}

}  // namespace
}  // namespace mammotwin
