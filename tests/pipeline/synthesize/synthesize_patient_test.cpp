#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "pipeline/synthesize/patient.h"
#include "pipeline/synthesize/patient_files.h"

namespace mammotwin {
namespace {

/// Coarse and quick: 3 mm voxels.
PatientOptions coarse(std::uint64_t seed) {
  PatientOptions o;
  o.anatomy.seed = seed;
  o.scan.voxel_mm = 3;
  return o;
}

const SyntheticPatient& patient_7() {
  static const SyntheticPatient patient = make_patient(coarse(7));
  return patient;
}

TEST(SyntheticPatient, SameSeedSameBytes) {
  const SyntheticPatient again = make_patient(coarse(7));
  EXPECT_EQ(again.scan.image.values, patient_7().scan.image.values);
  EXPECT_EQ(again.labels.values, patient_7().labels.values);
  EXPECT_EQ(patient_toml(again), patient_toml(patient_7()));
  EXPECT_EQ(truth_json(again), truth_json(patient_7()));
}

TEST(SyntheticPatient, AnotherSeedIsAnotherPatient) {
  const SyntheticPatient other = make_patient(coarse(8));
  EXPECT_GT((other.truth.nipple_in_lps - patient_7().truth.nipple_in_lps).norm(), 0.1);
  EXPECT_NE(other.labels.values, patient_7().labels.values);
}

TEST(SyntheticPatient, PartsOfEveryVoxelSumToOne) {
  const TissueMap& tissue = patient_7().tissue;
  for (const VoxelMixture& m : tissue.mixtures.values)
    ASSERT_EQ(std::accumulate(m.parts.begin(), m.parts.end(), 0), tissue.parts_per_voxel);
}

TEST(SyntheticPatient, FractionsSumToOneInTheBreastAndToZeroOutside) {
  const SyntheticPatient& p = patient_7();
  const Segmentation s = true_segmentation(p.tissue, p.labels, p.truth);
  for (std::size_t n = 0; n < s.labels.values.size(); ++n) {
    const Fractions& f = s.fractions.values[n];
    // Three quotients of small integers in single precision: off by a few of its 6e-8.
    ASSERT_NEAR(f.fat + f.fibroglandular + f.lesion, label::is_breast(s.labels.values[n]) ? 1 : 0,
                1e-6);
  }
}

TEST(SyntheticPatient, LesionsLieWhereTheLabelsHaveThem) {
  PatientOptions o = coarse(7);
  o.scan.voxel_mm = 1.5;
  const SyntheticPatient p = make_patient_without_scan(o);
  for (std::size_t n = 0; n < p.truth.lesions.size(); ++n) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (int k = 0; k < p.labels.size.z(); ++k)
      for (int j = 0; j < p.labels.size.y(); ++j)
        for (int i = 0; i < p.labels.size.x(); ++i)
          if (p.labels(i, j, k) == label::lesion + n) sum += p.labels.position(i, j, k), ++count;
    ASSERT_GT(count, 0);
    // Labels round partial volume to whole voxels: a lesion of 10 mm has some 150 voxels, two
    // thirds of them on its surface, each rounded by a quarter in the mean with random sign.
    EXPECT_LT((sum / count - p.truth.lesions[n].centroid_in_lps).norm(), 0.3);
    const double ml = count * p.labels.voxel_volume() / 1000;
    EXPECT_NEAR(ml / p.truth.lesions[n].volume_ml, 1, 0.1);
  }
}

TEST(SyntheticPatient, LesionsHaveTheSizeAskedFor) {
  PatientOptions o = coarse(11);
  o.scan.voxel_mm = 1.5;
  o.anatomy.lesions = 3;
  o.anatomy.lesion_min_mm = o.anatomy.lesion_max_mm = 14;
  for (const Lesion& lesion : make_patient_without_scan(o).truth.lesions) {
    const double diameter = std::cbrt(6000 * lesion.volume_ml / M_PI);
    EXPECT_NEAR(diameter, 14, 1.5);  // lobules add or take up to a tenth of the radius
  }
}

TEST(SyntheticPatient, BreastHasTheVolumeAskedFor) {
  for (const double asked : {160.0, 400.0, 1400.0}) {
    PatientOptions o = coarse(3);
    o.anatomy.volume_ml = asked, o.anatomy.subcutaneous_mm = 9, o.anatomy.lesions = 1;
    o.anatomy.lesion_min_mm = o.anatomy.lesion_max_mm = 8;
    // The size is found on columns 3 mm apart and measured on voxels, whose region may end a
    // column further in or out: 3 mm of an edge that is 2 to 4 % of the breast.
    EXPECT_NEAR(make_patient_without_scan(o).truth.breast_ml / asked, 1, 0.06) << asked << " ml";
  }
}

TEST(SyntheticPatient, BreastHasTheDensityAskedFor) {
  for (const double asked : {0.05, 0.3, 0.6}) {
    PatientOptions o = coarse(5);
    o.anatomy.density = asked;
    const Truth truth = make_patient_without_scan(o).truth;
    // Lesions, up to 2 % of the breast, are taken out of it.
    EXPECT_NEAR(truth.fibroglandular_ml / truth.breast_ml, asked, 0.03) << asked;
  }
}

TEST(SyntheticPatient, SkinHasItsThickness) {
  AnatomyOptions o;
  o.skin_mm = 2.4;
  const Anatomy anatomy(o);
  const Chest& chest = anatomy.chest();
  // From a point on the side of the breast along the skin's normal, in voxels of 0.2 mm.
  const Eigen::Vector3d axis = chest.breast(Side::left).axis(0.5);
  double lateral = 0;
  while (chest.outside(axis + lateral * Eigen::Vector3d::UnitX()) < 0) lateral += 0.01;
  const Eigen::Vector3d on_skin = axis + lateral * Eigen::Vector3d::UnitX();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int a = 0; a < 3; ++a)
    normal[a] = chest.outside(on_skin + 0.1 * Eigen::Vector3d::Unit(a)) -
                chest.outside(on_skin - 0.1 * Eigen::Vector3d::Unit(a));
  normal.normalize();
  constexpr double step = 0.2;
  constexpr int samples = 3;
  double skin = 0;
  for (double depth = -2; depth < 6; depth += step)
    skin += step * anatomy.sample_voxel(on_skin - depth * normal, step, samples)[Substance::skin] /
            (samples * samples * samples);
  // The distance is of first order: an error of thickness^2 / (2 x 40 mm radius), 0.07 mm.
  EXPECT_NEAR(skin, 2.4, 0.1);
}

TEST(SyntheticPatient, WithoutFaultsEveryMaterialHasItsIntensity) {
  PatientOptions o = coarse(7);
  o.scan.noise = o.scan.blur_voxels = o.scan.shading = o.scan.texture = 0;
  const SyntheticPatient p = make_patient(o);
  const auto level = intensities(o.scan);
  int pure = 0;
  for (std::size_t n = 0; n < p.tissue.mixtures.values.size(); ++n)
    for (int m = 0; m < num_substances; ++m)
      if (p.tissue.mixtures.values[n].parts[m] == p.tissue.parts_per_voxel) {
        ASSERT_EQ(p.scan.image.values[n], std::lround(fat_grey * level[m]));
        ++pure;
      }
  EXPECT_GT(pure, 100000);
}

TEST(SyntheticPatient, NoiseHasTheStrengthAskedFor) {
  PatientOptions o = coarse(7);
  o.scan.noise = 0.1;
  const SyntheticPatient p = make_patient(o);
  double squares = 0;
  int count = 0;
  for (std::size_t n = 0; n < p.labels.values.size(); ++n)
    if (p.tissue.mixtures.values[n][Substance::air] == p.tissue.parts_per_voxel && n % 7 == 0)
      squares += std::pow(p.scan.image.values[n], 2), ++count;
  // In air the squared Rician magnitude has the mean 2 sigma^2; rounding adds 1/12. Blur carries
  // some skin into the air next to it.
  EXPECT_NEAR(std::sqrt(squares / count / 2) / (0.1 * fat_grey), 1, 0.05);
}

TEST(SyntheticPatient, ClickedPointsAreFourMillimetresOff) {
  const auto clicked = clicked_points(patient_7());
  ASSERT_EQ(clicked.size(), 2u);
  for (std::size_t n = 0; n < clicked.size(); ++n)
    EXPECT_NEAR((clicked[n] - patient_7().truth.lesions[n].centroid_in_lps).norm(), 4, 1e-9);
}

TEST(SyntheticPatient, OptionsOutOfRangeAreNamed) {
  const auto message = [](auto change) {
    PatientOptions o;
    change(o);
    try {
      check(o);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(message([](PatientOptions&) {}), "");
  EXPECT_EQ(message([](PatientOptions& o) { o.anatomy.volume_ml = 0.65; }),
            "synthetic patient: volume_ml is 0.65; expected 150 to 1500 ml");
  EXPECT_EQ(message([](PatientOptions& o) { o.anatomy.lesions = 4; }),
            "synthetic patient: lesions is 4; expected 1 to 3");
  EXPECT_EQ(message([](PatientOptions& o) { o.anatomy.skin_mm = std::nan(""); }),
            "synthetic patient: skin_mm is nan; expected 1 to 3 mm");
  EXPECT_EQ(message([](PatientOptions& o) { o.anatomy.lesion_min_mm = 18; }),
            "synthetic patient: lesion_max_mm is 16; expected at least lesion_min_mm, 18 mm");
}

TEST(SyntheticPatient, WhatCannotBeMetTogetherIsSaid) {
  PatientOptions o = coarse(7);
  o.anatomy.volume_ml = 150, o.anatomy.lesions = 3;
  o.anatomy.subcutaneous_mm = 8, o.anatomy.lesion_min_mm = o.anatomy.lesion_max_mm = 20;
  EXPECT_THROW(make_patient_without_scan(o), std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin
