#include "pipeline/evaluate/segmentation/score.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

/// A slab of fat between air and muscle, shifted by whole voxels of 2 mm along y.
Segmentation slab(int skin_shift, int wall_shift) {
  Segmentation s;
  s.labels = Volume<std::uint8_t>({30, 30, 30}, Eigen::Vector3d::Constant(2),
                                  Eigen::Vector3d::Zero(), label::air);
  for (int k = 0; k < 30; ++k)
    for (int i = 0; i < 30; ++i)
      for (int j = 5 + skin_shift; j < 30; ++j)
        s.labels(i, j, k) = j < 20 + wall_shift ? label::fat : label::muscle;
  s.fractions = s.labels.like<Fractions>();
  s.labels(10, 12, 10) = s.labels(11, 12, 10) = label::lesion;
  s.lesions = {{"a", {21, 24, 20}, 0.016}};
  s.region = {Side::left, -1, 59, -1, 59};
  return s;
}

TEST(Score, OfTheTruthItselfIsPerfect) {
  const SegmentationScore score = score_segmentation(slab(0, 0), slab(0, 0));
  EXPECT_EQ(score.breast_dice, 1);
  EXPECT_EQ(score.chest_wall->mean, 0);
  EXPECT_EQ(score.skin_surface->largest, 0);
  EXPECT_EQ(score.lesion_dice, 1);
  EXPECT_EQ(score.lesion_centroid_mm, 0);
  EXPECT_FALSE(score.fibroglandular_dice) << "there is none";
}

TEST(Score, OfShiftedSurfacesIsTheirShift) {
  const SegmentationScore score = score_segmentation(slab(0, 0), slab(1, -2));
  EXPECT_NEAR(score.skin_surface->mean, 2, 1e-6);
  EXPECT_NEAR(score.chest_wall->mean, 4, 1e-6);
  EXPECT_NEAR(*score.breast_dice, 2 * 12.0 / (15 + 12), 1e-9);
}

TEST(Score, TakesTheWorstLesion) {
  Segmentation found = slab(0, 0);
  found.labels(11, 12, 10) = label::fat;
  found.lesions[0].centroid_in_lps.x() += 3;
  const SegmentationScore score = score_segmentation(slab(0, 0), found);
  EXPECT_NEAR(*score.lesion_dice, 2.0 / 3, 1e-9);
  EXPECT_NEAR(*score.lesion_centroid_mm, 3, 1e-9);
}

TEST(Score, ComparesFractionsWithoutAThreshold) {
  Segmentation truth = slab(0, 0), found = slab(0, 0);
  truth.fractions(5, 12, 5) = {0.5F, 0.5F, 0};
  truth.fractions(6, 12, 5) = {0, 1, 0};
  found.fractions(5, 12, 5) = {0.75F, 0.25F, 0};
  found.fractions(6, 12, 5) = {0, 1, 0};
  found.fractions(7, 12, 5) = {0.25F, 0.75F, 0};
  const SegmentationScore score = score_segmentation(truth, found);
  EXPECT_NEAR(*score.fibroglandular_fraction_dice, 2 * 1.25 / (1.5 + 2), 1e-6);
  EXPECT_NEAR(*score.fibroglandular_volume_ratio, 2 / 1.5, 1e-6);
}

TEST(Score, ScoresClearTissueApartFromHalves) {
  Segmentation truth = slab(0, 0), found = slab(0, 0);
  truth.labels(5, 12, 5) = label::fibroglandular;
  truth.fractions(5, 12, 5) = {0, 1, 0};
  truth.fractions(6, 12, 5) = {0.5F, 0.5F, 0};
  truth.fractions(7, 12, 5) = {0.7F, 0.3F, 0};
  found.labels(5, 12, 5) = found.labels(6, 12, 5) = label::fibroglandular;
  SegmentationScore score = score_segmentation(truth, found);
  EXPECT_NEAR(*score.fibroglandular_dice, 2.0 / 3, 1e-9);
  EXPECT_EQ(score.clear_fibroglandular_dice, 1);
  found.labels(7, 12, 5) = label::fibroglandular;
  EXPECT_NEAR(*score_segmentation(truth, found).clear_fibroglandular_dice, 2.0 / 3, 1e-9);
}

TEST(Score, LeavesTrueLesionsOutOfFibroglandularTissue) {
  Segmentation truth = slab(0, 0);
  truth.labels(5, 12, 5) = label::fibroglandular;
  Segmentation found = truth;
  found.labels(10, 12, 10) = label::fibroglandular;
  EXPECT_EQ(score_segmentation(truth, found).fibroglandular_dice, 1);
  found.labels(20, 12, 20) = label::fibroglandular;
  EXPECT_NEAR(*score_segmentation(truth, found).fibroglandular_dice, 2.0 / 3, 1e-9);
}

}  // namespace
}  // namespace mammotwin
