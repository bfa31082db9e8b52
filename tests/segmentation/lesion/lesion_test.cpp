#include "segmentation/lesion/lesion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "segmentation/image/crop.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/lesion/random_walker.h"

namespace mammotwin {
namespace {

/// A ball of 3.2 in gland of 1.8 on the left and fat of 1 on the right, with a bright vessel
/// through it; noise of 3.5 %.
struct BallAndVessel {
  Eigen::Vector3d centre{1, 2, -3};
  double radius = 7;
  Volume<float> image{{70, 70, 70}, Eigen::Vector3d::Ones(), {-35, -35, -35}, 0};
  Volume<std::uint8_t> truth = image.like<std::uint8_t>(0), allowed = image.like<std::uint8_t>(1);

  explicit BallAndVessel(bool brighter = true) {
    std::mt19937 random(5);
    std::normal_distribution<float> noise(0, 0.035F);
    for (int k = 0; k < 70; ++k)
      for (int j = 0; j < 70; ++j)
        for (int i = 0; i < 70; ++i) {
          const Eigen::Vector3d x = image.position(i, j, k);
          truth(i, j, k) = (x - centre).norm() < radius;
          const bool vessel = std::hypot(x.x() - 1, x.y() - 2) < 1.5;
          float value = x.x() < -2 ? 1.8F : 1.0F;
          if (truth(i, j, k) || vessel) value = 3.2F;
          image(i, j, k) = (brighter ? value : (truth(i, j, k) ? 0.42F : 1.0F)) + noise(random);
        }
  }

  double dice(const FoundLesion& found) const {
    double both = 0, sum = 0;
    for (int k = 0; k < 70; ++k)
      for (int j = 0; j < 70; ++j)
        for (int i = 0; i < 70; ++i) sum += truth(i, j, k);
    for (int k = 0; k < found.mask.size.z(); ++k)
      for (int j = 0; j < found.mask.size.y(); ++j)
        for (int i = 0; i < found.mask.size.x(); ++i)
          if (found.mask(i, j, k)) {
            ++sum;
            both += truth(i + found.low.x(), j + found.low.y(), k + found.low.z());
          }
    return 2 * both / sum;
  }
};

SharpImage as_it_is(const Volume<float>& image) {
  return [&image](const auto& low, const auto& high) { return cropped(image, low, high); };
}

TEST(Lesion, StopsAtItsEdgeAndDropsTheVessel) {
  const BallAndVessel scene;
  const FoundLesion found = find_lesion(scene.image, as_it_is(scene.image), scene.allowed,
                                        scene.centre + Eigen::Vector3d(3, -2, 1.5), {});
  EXPECT_GT(scene.dice(found), 0.9);
  EXPECT_GT(found.agreement, 0.8);
  EXPECT_NEAR(found.brightness, 3.2, 0.05);
  EXPECT_FALSE(found.is_sphere);
}

TEST(Lesion, RandomWalkerAgrees) {
  const BallAndVessel scene;
  LesionSearch search;
  search.random_walker = true;
  EXPECT_GT(scene.dice(find_lesion(scene.image, as_it_is(scene.image), scene.allowed, scene.centre,
                                   search)),
            0.85);
}

TEST(Lesion, DarkOneInFatIsFound) {
  const BallAndVessel scene(false);
  LesionSearch search;
  search.brighter = false;
  const FoundLesion found =
      find_lesion(scene.image, as_it_is(scene.image), scene.allowed, scene.centre, search);
  EXPECT_GT(scene.dice(found), 0.9);
  EXPECT_NEAR(found.brightness, 0.42, 0.05);
}

/// A lesion of 3.2 in fat, where `holds` a point [mm].
template <class Holds>
Volume<float> lesion_in_fat(const Holds& holds, Volume<std::uint8_t>& truth) {
  Volume<float> image({110, 80, 80}, Eigen::Vector3d::Ones(), {-40, -40, -40}, 1);
  truth = image.like<std::uint8_t>(0);
  for (int k = 0; k < 80; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 110; ++i)
        if (holds(image.position(i, j, k))) truth(i, j, k) = 1, image(i, j, k) = 3.2F;
  return image;
}

double volume_ratio(const FoundLesion& found, const Volume<std::uint8_t>& truth) {
  const auto count = [](const Volume<std::uint8_t>& mask) {
    return static_cast<double>(std::count(mask.values.begin(), mask.values.end(), 1));
  };
  return count(found.mask) / count(truth);
}

TEST(Lesion, LobesOfALargeOneStay) {
  // A ball of 14 mm, whose half would open lobes away, with a lobe of 5 mm radius.
  Volume<std::uint8_t> truth;
  const Volume<float> image = lesion_in_fat(
      [](const Eigen::Vector3d& x) {
        return x.norm() < 14 || (x.x() > 0 && x.x() < 28 && std::hypot(x.y(), x.z()) < 5);
      },
      truth);
  const FoundLesion found =
      find_lesion(image, as_it_is(image), image.like<std::uint8_t>(1), {1, 2, -1}, {});
  EXPECT_NEAR(volume_ratio(found, truth), 1, 0.05);
}

TEST(Lesion, LobeOnANeckStaysIfItIsAsBright) {
  // The neck is thinner than what opening takes off.
  const auto lobe = [](const Eigen::Vector3d& x) {
    return (x - Eigen::Vector3d(17, 0, 0)).norm() < 5;
  };
  Volume<std::uint8_t> truth;
  Volume<float> image = lesion_in_fat(
      [&](const Eigen::Vector3d& x) {
        return x.norm() < 9 || lobe(x) || (x.x() > 0 && x.x() < 17 && std::hypot(x.y(), x.z()) < 2);
      },
      truth);
  const auto allowed = image.like<std::uint8_t>(1);
  EXPECT_NEAR(volume_ratio(find_lesion(image, as_it_is(image), allowed, {1, 2, -1}, {}), truth), 1,
              0.05);

  double voxels = 0, in_lobe = 0;
  for (int k = 0; k < 80; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 110; ++i) {
        voxels += truth(i, j, k);
        if (lobe(image.position(i, j, k))) image(i, j, k) = 4.5F, ++in_lobe;  // a vessel, say
      }
  EXPECT_NEAR(volume_ratio(find_lesion(image, as_it_is(image), allowed, {1, 2, -1}, {}), truth),
              1 - in_lobe / voxels, 0.05);
}

TEST(Lesion, TongueStaysIfItIsThickAndAsBright) {
  // Opening by 3 mm takes tongues and vessels off a ball of 7 mm.
  const auto found_share = [](double tongue_mm, float brightness, bool brighter) {
    Volume<std::uint8_t> truth;
    Volume<float> image =
        lesion_in_fat([](const Eigen::Vector3d& x) { return x.norm() < 7; }, truth);
    double ball = 0, tongue = 0;
    for (int k = 0; k < 80; ++k)
      for (int j = 0; j < 80; ++j)
        for (int i = 0; i < 110; ++i) {
          const Eigen::Vector3d x = image.position(i, j, k);
          ball += truth(i, j, k);
          if (truth(i, j, k) || x.x() < 0 || x.x() > 14 || std::hypot(x.y(), x.z()) > tongue_mm)
            continue;
          image(i, j, k) = brightness, ++tongue;
        }
    if (!brighter)
      for (float& value : image.values) value = 4.2F - value;
    LesionSearch search;
    search.brighter = brighter;
    const FoundLesion found =
        find_lesion(image, as_it_is(image), image.like<std::uint8_t>(1), {1, 2, -1}, search);
    return (volume_ratio(found, truth) * ball - ball) / tongue;
  };
  EXPECT_GT(found_share(2.8, 3.2F, true), 0.8);
  EXPECT_LT(found_share(1.5, 3.2F, true), 0.2) << "a vessel";
  EXPECT_LT(found_share(2.8, 2.5F, true), 0.3) << "not as bright";
  EXPECT_LT(found_share(2.8, 3.2F, false), 0.3) << "dark: gland";
}

TEST(Lesion, LongerThanTheUsualSearchIsFollowed) {
  // From the point it goes on for 42 mm.
  Volume<std::uint8_t> truth;
  const Volume<float> image = lesion_in_fat(
      [](const Eigen::Vector3d& x) {
        return (x - Eigen::Vector3d(20, 0, 0)).cwiseQuotient(Eigen::Vector3d(32, 12, 12)).norm() <
               1;
      },
      truth);
  const auto allowed = image.like<std::uint8_t>(1);
  LesionSearch search;
  const FoundLesion whole = find_lesion(image, as_it_is(image), allowed, {10, 0, 0}, search);
  EXPECT_FALSE(whole.is_cut);
  EXPECT_NEAR(volume_ratio(whole, truth), 1, 0.05);
  search.reach_mm = 25;
  const FoundLesion part = find_lesion(image, as_it_is(image), allowed, {10, 0, 0}, search);
  EXPECT_TRUE(part.is_cut);
  EXPECT_LT(volume_ratio(part, truth), 0.9);
}

TEST(Lesion, EdgeThatFadesIsSoft) {
  Volume<std::uint8_t> truth;
  const auto ball = [](const Eigen::Vector3d& x) { return x.norm() < 8; };
  Volume<float> image = lesion_in_fat(ball, truth);
  const auto allowed = image.like<std::uint8_t>(1);
  const FoundLesion sharp = find_lesion(image, as_it_is(image), allowed, {1, 2, -1}, {});
  EXPECT_FALSE(sharp.is_soft());
  EXPECT_NEAR(sharp.extent_mm.maxCoeff(), 15, 0.1);
  // A rim of 3 mm with two fifths of its contrast.
  for (int k = 0; k < 80; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 110; ++i)
        if (const double r = image.position(i, j, k).norm(); r >= 8 && r < 11)
          image(i, j, k) = 1.88F;
  const FoundLesion soft = find_lesion(image, as_it_is(image), allowed, {1, 2, -1}, {});
  EXPECT_TRUE(soft.is_soft());
  EXPECT_NEAR(soft.soft_extent_mm.maxCoeff(), 21, 0.1);
}

TEST(Lesion, WhereNothingStandsOutABallIsTaken) {
  BallAndVessel scene;
  for (float& value : scene.image.values) value = 1;
  const FoundLesion found =
      find_lesion(scene.image, as_it_is(scene.image), scene.allowed, {10, 10, 10}, {});
  EXPECT_TRUE(found.is_sphere);
}

TEST(RandomWalker, SplitsAStepAtTheStep) {
  Volume<float> image({20, 5, 5}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 0);
  auto seeds = image.like<std::uint8_t>(walker_free);
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 8; ++i) image(i, j, k) = 1;  // the step is nearer to the inside seed
      seeds(0, j, k) = walker_inside;
      seeds(19, j, k) = walker_outside;
    }
  const auto inside = random_walk(image, image.like<std::uint8_t>(1), seeds, 1);
  EXPECT_TRUE(inside(7, 2, 2));
  EXPECT_FALSE(inside(8, 2, 2));
}

TEST(Lesion, ItsSurfaceIsJudgedInTheSharpImage) {
  Volume<float> sharp({60, 60, 60}, Eigen::Vector3d::Ones(), {-30, -30, -30}, 1);
  double voxels = 0;
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i)
        if (sharp.position(i, j, k).norm() < 2.3) sharp(i, j, k) = 3, ++voxels;
  const Volume<float> blurred = gaussian_smoothed(sharp, 1.6);
  const auto allowed = sharp.like<std::uint8_t>(1);
  const auto found_voxels = [&](const Volume<float>& seen) {
    const FoundLesion found = find_lesion(blurred, as_it_is(seen), allowed, {1, 1, 0}, {});
    return static_cast<double>(std::count(found.mask.values.begin(), found.mask.values.end(), 1));
  };
  EXPECT_EQ(found_voxels(sharp), voxels);
  EXPECT_NE(found_voxels(blurred), voxels);
}

}  // namespace
}  // namespace mammotwin
