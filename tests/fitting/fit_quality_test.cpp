#include "fitting/fit_quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fitting/flat_target.h"

namespace mammotwin {
namespace {

constexpr double kSide = FlatTarget::side, kDepth = FlatTarget::depth;
const Eigen::Vector3d kFarAway(1e6, 0, 0);

SurfaceDistances skin_distances(const FlatTarget& flat, const Eigen::Vector3d& landmark) {
  return surface_distances(flat.box, slab_faces(flat.slab), FaceLabel::skin, flat.skin, landmark);
}

TEST(FitQuality, PlanesThreeApartAreThreeApartInEveryFigure) {
  const FlatTarget flat({2, 2, 1}, 3);
  const SurfaceDistances d = skin_distances(flat, kFarAway);
  for (double figure : {d.rms_mesh_to_data, d.rms_data_to_mesh, d.p95, d.max})
    EXPECT_NEAR(figure, 3, 1e-9);
  EXPECT_EQ(d.max_at_landmark, 0);
  EXPECT_NEAR(skin_distances(flat, {0, -kDepth, 0}).max_at_landmark, 3, 1e-9);
}

// Data that leave the mesh by d = a x / side. Vertices count with the area around them, so over n
// columns the mean of d² is the trapezoidal rule's, a² (1/3 + 1 / (6 n²)): n = 8 for the data, 20
// an element for the mesh, whose distances are perpendicular to the data: a cos θ instead of a.
TEST(FitQuality, RootMeanSquaresOfATiltedSkinAreThoseOfItsDistances) {
  FlatTarget flat({2, 2, 1}, 0);
  const double a = 2;
  for (auto& x : flat.skin.vertices) x.y() -= a * x.x() / kSide;
  const auto rms = [](double height, int n) {
    return height * std::sqrt(1.0 / 3 + 1.0 / (6.0 * n * n));
  };
  const SurfaceDistances d = skin_distances(flat, kFarAway);
  EXPECT_NEAR(d.rms_data_to_mesh, rms(a, 8), 1e-9);
  EXPECT_NEAR(d.rms_mesh_to_data, rms(a * std::cos(std::atan(a / kSide)), 40), 1e-9);
  // Of the data's area 15/16 lie around columns 0 to 7, so that the 95th percentile is column 8's.
  EXPECT_NEAR(d.p95, a, 1e-9);
  EXPECT_NEAR(d.max, a, 1e-9);
  EXPECT_NEAR(d.farthest.x(), kSide, 1e-9);
}

TEST(FitQuality, DistanceOnTheSkinIsNegativeInsideTheDataAndNoughtElsewhere) {
  const FlatTarget flat({2, 2, 2}, 3);
  const MeshFile file{flat.box, slab_faces(flat.slab), {}, {}, {}, {}};
  const PointField field = skin_distance_field(file, flat.skin);
  const PointField expected = interpolate_field(flat.box, [&](const MeshPoint& p) {
    return flat.box.position(p).y() < -kDepth + 1e-9 ? -3.0 : 0.0;
  });
  ASSERT_EQ(field.values.size(), expected.values.size());
  for (std::size_t n = 0; n < field.values.size(); ++n)
    EXPECT_NEAR(field.values[n], expected.values[n], 1e-9);
}

TEST(FitQuality, PointsToFacesAreMeasuredFromTheNearestFaceOfTheirLabel) {
  const FlatTarget flat({2, 2, 1}, 0);
  const std::vector<Eigen::Vector3d> points = {{5, -kDepth - 3, 5}, {15, -kDepth + 4, 9}};
  const auto rms = [&](FaceLabel label) {
    return rms_to_faces(flat.box, slab_faces(flat.slab), label, points);
  };
  EXPECT_NEAR(rms(FaceLabel::skin), std::sqrt((9 + 16) / 2.0), 1e-9);
  EXPECT_NEAR(rms(FaceLabel::chest_wall), std::sqrt((169 + 36) / 2.0), 1e-9);
}

/// Voxels of 1 mm over the box and as much in front of it and behind it, all fat.
Volume<std::uint8_t> fat_all_round() {
  return Volume<std::uint8_t>({40, 30, 20}, {1, 1, 1}, {0.5, -2 * kDepth + 0.5, 0.5}, label::fat);
}

TEST(FitQuality, CoverageCountsTheRegionsBreastInFrontOfTheWall) {
  const FlatTarget flat({2, 2, 1}, 0);
  const BreastRegion region{Side::left, 0, kSide, 0, kSide};
  Volume<std::uint8_t> labels = fat_all_round();
  // Of 30 mm of fat the mesh holds the middle 10; beyond x = 20 no voxel counts.
  EXPECT_DOUBLE_EQ(coverage(flat.box, labels, region).breast, 1.0 / 3);
  for (int k = 0; k < labels.size.z(); ++k)
    for (int i = 0; i < labels.size.x(); ++i) labels(i, 20, k) = label::muscle;
  EXPECT_DOUBLE_EQ(coverage(flat.box, labels, region).breast, 1.0 / 2);
  EXPECT_EQ(coverage(flat.box, labels, region).lesions, 1);  // there is none to miss
}

TEST(FitQuality, CoverageCountsLesionsBeyondTheRegionToo) {
  const FlatTarget flat({2, 2, 1}, 0);
  const BreastRegion region{Side::left, 0, kSide, 0, kSide};
  Volume<std::uint8_t> labels = fat_all_round();
  for (int j = 12; j < 16; ++j) labels(5, j, 5) = label::lesion;   // within the mesh
  labels(5, 2, 5) = label::lesion;                                 // in front of it
  for (int j = 12; j < 15; ++j) labels(30, j, 5) = label::lesion;  // beside the region
  EXPECT_DOUBLE_EQ(coverage(flat.box, labels, region).lesions, 4.0 / 8);
}

}  // namespace
}  // namespace mammotwin
