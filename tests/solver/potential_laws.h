#pragma once

#include <gtest/gtest.h>

#include "solver/element/surface_potential.h"

namespace mammotwin {

/// A surface potential's gradient and Hessian of position against central differences.
inline void expect_consistent(const SurfacePotential& potential,
                              const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point) {
  constexpr double h = 1e-5;  // [mm]: second differences leave 1e-10 of third derivatives
  SurfaceResponse exact, plus, minus;
  ASSERT_TRUE(potential.respond(y, point, 2, exact));
  const double scale = exact.hessian.topLeftCorner<3, 3>().cwiseAbs().maxCoeff();
  for (int k = 0; k < 3; ++k) {
    Eigen::Matrix<double, 9, 1> y_plus = y, y_minus = y;
    y_plus[k] += h;
    y_minus[k] -= h;
    ASSERT_TRUE(potential.respond(y_plus, point, 1, plus));
    ASSERT_TRUE(potential.respond(y_minus, point, 1, minus));
    EXPECT_NEAR((plus.energy - minus.energy) / (2 * h), exact.gradient[k], 1e-7 * scale) << k;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR((plus.gradient[i] - minus.gradient[i]) / (2 * h), exact.hessian(i, k),
                  1e-6 * scale)
          << i << "," << k;
  }
}

}  // namespace mammotwin
