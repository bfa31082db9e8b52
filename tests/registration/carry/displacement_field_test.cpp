#include "registration/carry/displacement_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/registration/squeezed_box.h"

namespace mammotwin {
namespace {

TEST(DisplacementField, TakesTissueToTheOtherConfiguration) {
  const SqueezedBox breast = squeezed_box(Side::left, 45, 0.5);
  const DisplacementField field = displacement_field(breast.prone, breast.compressed, 5);
  const Eigen::Vector3d x(61, -33, 12);
  // The map is affine, so trilinear interpolation is exact up to the floats that hold it.
  EXPECT_LT((x + displacement_at(field, x) - (breast.A * x + breast.b)).norm(), 1e-4);
}

TEST(DisplacementField, BothDirectionsComposeToIdentityUpToTheSurface) {
  const SqueezedBox breast = squeezed_box(Side::left, 0, 0.5);
  const DisplacementField there = displacement_field(breast.prone, breast.compressed, 5);
  const DisplacementField back = displacement_field(breast.compressed, breast.prone, 5);
  const CompositionError error = composition_error(there, back, breast.prone);
  EXPECT_NEAR(error.points, 100 * 60 * 80 / 125.0, 0.1 * 100 * 60 * 80 / 125.0);
  EXPECT_LT(error.max_mm, 1e-4);
}

// Stretched and squeezed in turn along x, u = 5 mm sin(k x) with a period of 60 mm: linear
// interpolation over 5 mm is off by up to h^2 / 8 |u''| = 25 / 8 * 5 (2 pi / 60)^2 = 0.17 mm.
TEST(DisplacementField, IsCorrectedUntilBothCompose) {
  const HermiteMesh box = block_mesh({0, 0, 0}, {120, 60, 60}, {8, 4, 4});
  std::vector<HermiteMesh::Node> waved = box.nodes();
  const double k = 2 * std::numbers::pi / 60;
  for (HermiteMesh::Node& node : waved) {
    const double x = node(0, 0), slope = node(0, 1);  // dx/dxi1; all else is 0 or along y, z
    node(0, 0) += 5 * std::sin(k * x);
    node(0, 1) += 5 * k * std::cos(k * x) * slope;
  }
  const HermiteMesh wave(waved, box.elements());
  const DisplacementField there = displacement_field(box, wave, 5);
  DisplacementField back = displacement_field(wave, box, 5);
  EXPECT_GT(composition_error(there, back, box).max_mm, 0.1);
  compose_to_identity(there, box, 0.05, back);
  // 12 voxels a period cannot carry it to 0.05: what the nodes can do is below what is asked, 0.1.
  EXPECT_LE(composition_error(there, back, box).max_mm, 0.1);
}

TEST(DisplacementField, FadesToNothingFarFromTheBreast) {
  const SqueezedBox breast = squeezed_box(Side::left, 45, 0.5);
  const DisplacementField field = displacement_field(breast.compressed, breast.prone, 5);
  const auto empty =
      std::count_if(field.values.begin(), field.values.end(),
                    [](const Eigen::Vector3f& d) { return d == Eigen::Vector3f::Zero(); });
  // Squeezed obliquely the box is a parallelogram: two corners of its grid stay empty.
  EXPECT_GT(empty, static_cast<long>(field.values.size()) / 10);
  EXPECT_EQ(displacement_at(field, {1000, 0, 0}), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace mammotwin
