#include "registration/displacement_field.h"

#include "squeezed_box.h"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(DisplacementField, FadesToNothingFarFromTheBreast) {
  const SqueezedBox breast = squeezed_box(Side::left, 45, 0.5);
  const DisplacementField field = displacement_field(breast.compressed, breast.prone, 5);
  const auto empty = std::count_if(field.values.begin(), field.values.end(),
                                   [](const Eigen::Vector3f& d) { return d == Eigen::Vector3f::Zero(); });
  // Squeezed obliquely the box is a parallelogram: two corners of its grid stay empty.
  EXPECT_GT(empty, static_cast<long>(field.values.size()) / 10);
  EXPECT_EQ(displacement_at(field, {1000, 0, 0}), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace mammotwin
