#include "segmentation/body/breast_region.h"

#include <cmath>

#include "segmentation/body/tissue_columns.h"
#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

constexpr double chest_front = 60;  // y of the flat muscle front [mm]
constexpr double coat = 10;         // tissue over the chest everywhere [mm]

/// Two paraboloid breasts of 60 and 50 mm height and 60 mm radius at x = -75 and 85, z = 0, over a
/// chest with 10 mm of fat; 2 mm voxels.
Volume<std::uint8_t> two_breasts() {
  Volume<std::uint8_t> labels({160, 70, 100}, Eigen::Vector3d::Constant(2), {-159, -51, -99},
                              label::air);
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const Eigen::Vector3d x = labels.position(i, j, k);
        const auto bump = [&](double c, double h) {
          return h * std::max(0.0, 1 - (std::pow(x.x() - c, 2) + x.z() * x.z()) / 3600);
        };
        const double skin = chest_front - coat - bump(-75, 60) - bump(85, 50);
        if (x.y() > chest_front)
          labels(i, j, k) = label::muscle;
        else if (x.y() > skin)
          labels(i, j, k) = label::fat;
      }
  return labels;
}

/// Tissue is thicker than 0.35 (10 + h) within r = 60 sqrt(1 - (0.35 (10 + h) - 10) / h).
double thick_radius(double h) { return 60 * std::sqrt(1 - (0.35 * (10 + h) - 10) / h); }

TEST(BreastRegion, ReachesFifteenMmBeyondTheThickPart) {
  const BreastRegion left = find_breast_region(two_breasts(), Side::left);
  const double r = thick_radius(50);
  // Voxels of 2 mm, and their outer faces.
  EXPECT_NEAR(left.x_max, 85 + r + 15, 3);
  EXPECT_NEAR(left.z_min, -r - 15, 3);
  EXPECT_NEAR(left.z_max, r + 15, 3);
  EXPECT_NEAR(left.x_min, 5, 3) << "the valley between -15 and 25";
  const BreastRegion right = find_breast_region(two_breasts(), Side::right);
  EXPECT_NEAR(right.x_max, 5, 3);
  EXPECT_NEAR(right.x_min, -75 - thick_radius(60) - 15, 3);
}

TEST(BreastRegion, OfOneHalfIsTheSameAsOfBoth) {
  auto half = two_breasts();
  const BreastRegion both = find_breast_region(half, Side::left);
  for (int k = 0; k < half.size.z(); ++k)
    for (int j = 0; j < half.size.y(); ++j)
      for (int i = 0; i < half.size.x(); ++i)
        if (half.position(i, j, k).x() < both.x_min) half(i, j, k) = label::air;
  const BreastRegion one = find_breast_region(half, Side::left);
  EXPECT_DOUBLE_EQ(one.x_min, both.x_min);
  EXPECT_DOUBLE_EQ(one.x_max, both.x_max);
  EXPECT_DOUBLE_EQ(one.z_min, both.z_min);
  EXPECT_DOUBLE_EQ(one.z_max, both.z_max);
}

TEST(BreastRegion, IsPulledInWhereTissueIsThin) {
  auto labels = two_breasts();
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const Eigen::Vector3d x = labels.position(i, j, k);
        // 6 mm of tissue beyond x = 135: enough elsewhere, too little for the lateral edge.
        if (x.x() > 135 && x.y() < chest_front - 6) labels(i, j, k) = label::air;
      }
  const BreastRegion region = find_breast_region(labels, Side::left);
  EXPECT_NEAR(region.x_max, 135, 2);
}

TEST(BreastRegion, AWingedGapInACornerCostsTheUpperEdgeAndNotTheBreast) {
  auto labels = two_breasts();
  const double top = thick_radius(50) + 15;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const Eigen::Vector3d x = labels.position(i, j, k);
        // 15 mm of the upper edge are poor and 20 mm of the medial one, which would therefore be
        // pulled in first, and then 55 mm, past the wing.
        const bool corner = x.z() > top - 20 && x.x() < 5 + 15;
        const bool wing = x.z() > top - 20 && x.z() < top - 15 && x.x() < 5 + 55;
        if ((corner || wing) && x.x() > 0) labels(i, j, k) = label::air;
      }
  const BreastRegion region = find_breast_region(labels, Side::left);
  EXPECT_NEAR(region.x_min, 5, 3);
  EXPECT_NEAR(region.z_max, top - 20, 3);
}

TEST(BreastRegion, HoldsEveryLesionOfItsSide) {
  auto labels = two_breasts();
  const Eigen::Vector3i far = labels.index({85, 55, 88}).array().round().cast<int>();
  labels(far.x(), far.y(), far.z()) = label::lesion;
  const BreastRegion left = find_breast_region(labels, Side::left);
  EXPECT_TRUE(left.contains(labels.position(far.x(), far.y(), far.z())));
  EXPECT_NEAR(find_breast_region(labels, Side::right).z_max, thick_radius(60) + 15, 3);
}

/// The left half of the breasts, with a ghost of 40 mm beside the body that reaches less far
/// forward than the breast and more than the chest.
Volume<std::uint8_t> half_with_an_island() {
  Volume<std::uint8_t> labels({140, 70, 100}, Eigen::Vector3d::Constant(2), {6, -51, -99},
                              label::air);
  const Volume<std::uint8_t> both = two_breasts();
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const Eigen::Vector3d x = labels.position(i, j, k);
        const Eigen::Vector3i v = both.index(x).array().round().cast<int>();
        if (x.x() < 159)
          labels(i, j, k) = both(v.x(), v.y(), v.z());
        else if ((x - Eigen::Vector3d(220, 44, 40)).norm() < 40)
          labels(i, j, k) = label::fat;
      }
  return labels;
}

TEST(BreastRegion, AnIslandBesideTheBodyMakesNoValley) {
  const FoundRegion found = find_region(half_with_an_island(), Side::left, LabelsHold::one_side);
  EXPECT_NEAR(found.region.x_min, 5, 3);
  EXPECT_NEAR(found.region.x_max, 85 + thick_radius(50) + 15, 3);
  EXPECT_LT(found.outside.share, 0.03);
}

TEST(BreastRegion, TellsHowMuchOfTheBreastItLeavesOut) {
  auto labels = two_breasts();
  // A slit above the apex, open to the medial side: no rectangle that holds the apex and no empty
  // column reaches beyond it.
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const Eigen::Vector3d x = labels.position(i, j, k);
        if (std::abs(x.z() - 13) < 2.1 && x.x() < 100) labels(i, j, k) = label::air;
      }
  const FoundRegion found = find_region(labels, Side::left);
  EXPECT_LT(found.region.z_max, 13);
  // Slices of a paraboloid hold as (1 - z^2 / 60^2)^1.5: 0.36 of it lies above z = 10, of which the
  // slit takes about 0.05.
  EXPECT_NEAR(found.outside.share, 0.32, 0.04);
  EXPECT_GT(found.outside.middle_in_lps.z(), 15);
}

/// A breast beside whose foot the flank falls off steeply, thick along the columns as far as the
/// body is imaged, from under the breast on.
Volume<std::uint8_t> breast_and_flank(int columns_of_flank) {
  Volume<std::uint8_t> labels({70 + columns_of_flank, 130, 80}, Eigen::Vector3d::Constant(2),
                              {2, -51, -79}, label::air);
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const Eigen::Vector3d x = labels.position(i, j, k);
        const double height =
            60 * std::max(0.0, 1 - (std::pow(x.x() - 60, 2) + x.z() * x.z()) / 2500);
        const double fall = 2.5 * std::max(0.0, x.x() - 110);
        if (x.y() > chest_front + 40 + fall || (x.x() < 90 && x.y() > chest_front))
          labels(i, j, k) = label::muscle;
        else if (x.y() > chest_front - coat - height + fall)
          labels(i, j, k) = label::fat;
      }
  return labels;
}

TEST(BreastRegion, EndsLaterallyByHowFarTheBreastHangsAndNotByTheFlank) {
  const FoundRegion narrow = find_region(breast_and_flank(15), Side::left, LabelsHold::one_side);
  const FoundRegion wide = find_region(breast_and_flank(40), Side::left, LabelsHold::one_side);
  EXPECT_NEAR(narrow.region.x_max, wide.region.x_max, 1e-9);
  // It hangs to 110 mm; 1 % of a paraboloid lies beyond 0.75 of its radius of 50 mm or so.
  EXPECT_NEAR(wide.region.x_max, 60 + 40 + 35, 5);
}

TEST(BreastRegion, IsWidenedWhereTheThickPartLeavesBreastOut) {
  // A tall peg on a wide, low breast: thick (over 0.35 of the peg's column) is the peg alone.
  Volume<std::uint8_t> labels({160, 90, 100}, Eigen::Vector3d::Constant(2), {-159, -91, -99},
                              label::air);
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const Eigen::Vector3d x = labels.position(i, j, k);
        const double off = std::hypot(std::abs(x.x()) - 80, x.z());
        const double height = std::max(off < 70 ? 25.0 : 0.0, off < 15 ? 120.0 : 0.0);
        if (x.y() > chest_front)
          labels(i, j, k) = label::muscle;
        else if (x.y() > chest_front - coat - height)
          labels(i, j, k) = label::fat;
      }
  const FoundRegion found = find_region(labels, Side::left);
  EXPECT_LT(found.outside.share, 0.03);
}

/// A left breast that leans outwards from its foot to its head; above its middle, muscle lies close
/// under the skin on its medial side.
Volume<std::uint8_t> leaning_breast() {
  Volume<std::uint8_t> labels({90, 70, 90}, Eigen::Vector3d::Constant(2), {2, -51, -89},
                              label::air);
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const Eigen::Vector3d x = labels.position(i, j, k);
        const double from_middle = (x.x() - 85 - 0.5 * x.z()) / 45;
        const double height =
            70 * std::sqrt(std::max(0.0, 1 - from_middle * from_middle - x.z() * x.z() / 6400));
        const double cover = x.z() > 0 && from_middle < -1 ? 2 : coat;
        if (x.y() > chest_front)
          labels(i, j, k) = label::muscle;
        else if (x.y() > chest_front - cover - height)
          labels(i, j, k) = label::fat;
      }
  return labels;
}

TEST(BreastRegion, HoldsABreastWhoseMedialEdgeSlantsOverTheBreastbone) {
  auto labels = leaning_breast();
  const FoundRegion found = find_region(labels, Side::left, LabelsHold::one_side);
  EXPECT_LT(found.outside.share, 0.03);
  EXPECT_GT(found.thin_mm2, 100);
  set_muscle_back(labels, found.region, least_tissue_mm);
  const TissueColumns columns = measure_columns(labels);
  int within = 0;
  for (int k = 0; k < columns.nz; ++k)
    for (int i = 0; i < columns.nx; ++i)
      if (found.region.contains(labels.position(i, 0, k))) {
        ++within;
        EXPECT_GE(columns.tissue[columns.at(i, k)], least_tissue_mm) << i << ' ' << k;
      }
  EXPECT_GT(within, 1000);
}

TEST(BreastRegion, MovesNoMuscleWhereTheBreastIsHeldAnyway) {
  EXPECT_EQ(find_region(two_breasts(), Side::left).thin_mm2, 0);
}

TEST(BreastRegion, RefusesASideWithoutABreast) {
  Volume<std::uint8_t> flat({100, 40, 60}, Eigen::Vector3d::Constant(2), {-99, 0, 0}, label::air);
  for (int k = 0; k < flat.size.z(); ++k)
    for (int i = 0; i < flat.size.x(); ++i) flat(i, 30, k) = label::fat;
  expect_mentions(message_of([&] { find_breast_region(flat, Side::right); }),
                  {"right side", "2 mm", "15 mm"});
}

TEST(BreastRegion, EndsAtTheFoldWhereTheSkinComesForwardBelowIt) {
  constexpr double fold = -40;  // below it a coat that grows from 10 to 40 mm
  Volume<std::uint8_t> labels = two_breasts();
  const double usual = find_breast_region(labels, Side::left).z_min;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const Eigen::Vector3d x = labels.position(i, j, k);
        const double belly = std::min(30.0, fold - 12 - x.z());
        if (x.z() < fold - 12 && x.y() <= chest_front && x.y() > chest_front - coat - belly)
          labels(i, j, k) = label::fat;
      }
  const BreastRegion region = find_breast_region(labels, Side::left);
  EXPECT_LT(usual, fold - 15);
  // The breast ends between 40 mm (its edges) and 60 mm (its middle) below the nipple.
  EXPECT_NEAR(region.z_min, fold - 12, 5);
  EXPECT_NEAR(region.z_max, find_breast_region(two_breasts(), Side::left).z_max, 1e-9);
}

TEST(BreastRegion, ThatAPersonGaveIsKeptAndJudged) {
  Volume<std::uint8_t> labels = two_breasts();
  for (int k = 0; k < labels.size.z(); ++k)  // as the stages leave it: one side only
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i)
        if (labels.position(i, j, k).x() < 0) labels(i, j, k) = label::air;
  const FoundRegion whole = given_region(labels, {Side::left, 20, 150, -70, 70});
  EXPECT_NEAR(whole.region.x_min, 20, 2);
  EXPECT_NEAR(whole.region.z_max, 70, 2);
  EXPECT_LT(whole.outside.share, 0.01);
  const FoundRegion half = given_region(labels, {Side::left, 20, 150, 0, 70});
  EXPECT_NEAR(half.outside.share, 0.5, 0.05);
  expect_mentions(message_of([&] {
                    given_region(labels, {Side::left, -900, -800, 0, 70});
                  }),
                  {"region given", "beside this breast"});
}

}  // namespace
}  // namespace mammotwin
