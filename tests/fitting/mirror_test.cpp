#include "fitting/mirror.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fitting/mesh/bezier.h"
#include "fitting/mesh/jacobian_bound.h"
#include "segmentation/mirrored.h"
#include "tests/fitting/dome.h"

namespace mammotwin {
namespace {

/// A bell with a lump beside its tip, so that left and right differ.
Segmentation lopsided() {
  Segmentation s = dome_breast();
  const Eigen::Vector3d lump(16, -34, 10);
  constexpr double radius = 14;
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i)
        if ((s.labels.position(i, j, k) - lump).norm() < radius) s.labels(i, j, k) = label::fat;
  s.nipple_in_lps = {3, -52, 1};
  s.lesions.push_back({"L1", {10, -20, 5}, 0.5});
  return s;
}

FitOptions by_four() {
  FitOptions options;
  options.elements = Eigen::Vector3i(4, 4, 2);
  return options;
}

TEST(Mirror, TwiceIsTheSame) {
  const Segmentation s = lopsided(), same = mirrored(mirrored(s));
  EXPECT_EQ(same.labels.values, s.labels.values);
  EXPECT_LT((same.labels.origin - s.labels.origin).norm(), 1e-12);
  EXPECT_EQ(same.region.side, Side::left);
  EXPECT_EQ(same.region.x_min, s.region.x_min);
  EXPECT_EQ(same.region.x_max, s.region.x_max);
}

TEST(Mirror, LabelsLieOppositeTheirPlaces) {
  const Segmentation s = lopsided(), right = mirrored(s);
  EXPECT_EQ(right.region.side, Side::right);
  EXPECT_EQ(right.lesions[0].centroid_in_lps.x(), -10);
  const Eigen::Vector3d x = s.labels.position(31, 20, 34);
  const Eigen::Vector3d there(-x.x(), x.y(), x.z()), index = right.labels.index(there);
  EXPECT_EQ(right.labels(static_cast<int>(std::lround(index.x())), 20, 34), s.labels(31, 20, 34));
}

TEST(Mirror, ARightBreastGetsTheMeshOfTheLeftOneThatItMirrors) {
  const FitResult left = fit_breast(lopsided(), by_four());
  const FitResult right = fit_breast(mirrored(lopsided()), by_four());
  ASSERT_TRUE(left.report.usable());
  EXPECT_TRUE(proved_valid(right.mesh.mesh));
  EXPECT_EQ(right.mesh.faces, left.mesh.faces);
  EXPECT_NEAR(right.report.skin_rms_mesh_to_data_mm, left.report.skin_rms_mesh_to_data_mm, 1e-9);
  const Eigen::Vector3i n = *by_four().elements;
  for (int e = 0; e < left.mesh.mesh.num_elements(); ++e) {
    const int i = e % n.x(), opposite = e - i + n.x() - 1 - i;
    for (const Eigen::Vector3d& xi : {Eigen::Vector3d(0.2, 0.7, 0.4), Eigen::Vector3d(0, 1, 1)}) {
      const Eigen::Vector3d here = right.mesh.mesh.position({e, xi});
      const Eigen::Vector3d there =
          left.mesh.mesh.position({opposite, {1 - xi.x(), xi.y(), xi.z()}});
      EXPECT_LT((here - Eigen::Vector3d(-there.x(), there.y(), there.z())).norm(), 1e-6);
    }
  }
}

TEST(Mirror, TheSkinsDistanceIsPaintedOnTheSamePlaces) {
  const FitResult left = fit_breast(lopsided(), by_four()), right = mirrored(left);
  const BezierMesh here(right.mesh.mesh), there(left.mesh.mesh);
  const auto& painted = right.mesh.fields.at("skin_distance_mm").values;
  const auto& before = left.mesh.fields.at("skin_distance_mm").values;
  const int e = 16 + 5, opposite = 16 + 6;  // of the layer under the skin, second row
  for (int m : {48, 51, 60, 63})            // its corners on the skin
    EXPECT_EQ(painted[here.elements[e][m]],
              before[there.elements[opposite][m - m % 4 + 3 - m % 4]]);
}

}  // namespace
}  // namespace mammotwin
