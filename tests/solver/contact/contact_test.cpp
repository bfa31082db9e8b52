#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "solver/contact/plate.h"
#include "solver/contact/plate_contact.h"

namespace mammotwin {
namespace {

/// A tilted paddle: face normal along −up, edge rounded by 10 mm.
Plate paddle() {
  const Eigen::Matrix3d R(Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, -1).normalized()));
  return {{1, 2, 3}, R * Eigen::Vector3d(0, 0, -1), R * Eigen::Vector3d(0, -1, 0), 10, false};
}

Eigen::Vector3d at(const Plate& plate, double above, double behind, double sideways) {
  return plate.point + above * plate.normal - behind * plate.depth +
         sideways * plate.normal.cross(plate.depth);
}

TEST(Plate, GapIsTheDistanceToFaceRoundingAndWall) {
  const Plate plate = paddle();
  EXPECT_NEAR(plate.gap(at(plate, 4, -20, 7)).gap, 4, 1e-12);
  EXPECT_NEAR(plate.gap(at(plate, -2, -20, 7)).gap, -2, 1e-12);
  // Centre of the rounding lies 10 above-less: (3, 4) from it is 5 − 10 inside, (9, 12) 5 outside.
  EXPECT_NEAR(plate.gap(at(plate, -10 + 3, 4, 0)).gap, -5, 1e-12);
  EXPECT_NEAR(plate.gap(at(plate, -10 + 9, 12, 0)).gap, 5, 1e-12);
  EXPECT_NEAR(plate.gap(at(plate, -30, 13, 0)).gap, 3, 1e-12);
}

TEST(Plate, NormalAndHessianAreDerivativesOfTheGap) {
  const Plate plate = paddle();
  std::mt19937 random(3);
  const auto uniform = [&] { return 30 * (random() / 4294967295.0) - 15; };
  constexpr double h = 1e-5;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d x = at(plate, uniform(), uniform(), uniform());
    const Gap exact = plate.gap(x);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d dx = h * Eigen::Vector3d::Unit(k);
      const Gap plus = plate.gap(x + dx), minus = plate.gap(x - dx);
      // Curvature jumps where regions meet; there one side's difference is a mixture.
      if ((plus.hessian - minus.hessian).norm() > 1e-3) continue;
      EXPECT_NEAR((plus.gap - minus.gap) / (2 * h), exact.normal[k], 1e-7);
      EXPECT_NEAR(((plus.normal - minus.normal) / (2 * h) - exact.hessian.col(k)).norm(), 0, 1e-6);
    }
  }
}

TEST(PlateContact, PushesOnlyWhatIsInside) {
  PlateContact contact;
  contact.plates = {paddle()};
  contact.penalty = 7;
  SurfaceResponse response;
  Eigen::Matrix<double, 9, 1> y = Eigen::Matrix<double, 9, 1>::Zero();
  y.head<3>() = at(paddle(), 0.1, -5, 0);
  EXPECT_FALSE(contact.respond(y, {}, 2, response));
  y.head<3>() = at(paddle(), -0.1, -5, 0);
  ASSERT_TRUE(contact.respond(y, {}, 2, response));
  EXPECT_NEAR(response.energy, 7 * 0.1 * 0.1 / 2, 1e-12);
  EXPECT_NEAR((response.gradient.head<3>() + 0.7 * paddle().normal).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace mammotwin
