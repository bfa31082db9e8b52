#pragma once

#include <array>

#include "fitting/mesh/bezier.h"

namespace mammotwin {

/// Position [mm] and Jacobian ∂x/∂ξ [mm] at one point.
struct PositionAndJacobian {
  Eigen::Vector3d x;
  Eigen::Matrix3d jacobian;
};

/// Evaluates an element by sum factorisation of its control points.
inline PositionAndJacobian evaluate(const BezierElement& b, const Eigen::Vector3d& xi) {
  std::array<Eigen::Vector4d, 3> value, slope;
  for (int a = 0; a < 3; ++a) {
    const double t = xi[a], s = 1 - t;
    value[a] << s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t;
    slope[a] << -3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t;
  }
  Eigen::Matrix<double, 3, 16> plane, plane_1;
  for (int m = 0; m < 16; ++m) {
    plane.col(m) = b.middleCols<4>(4 * m) * value[0];
    plane_1.col(m) = b.middleCols<4>(4 * m) * slope[0];
  }
  Eigen::Matrix<double, 3, 4> line, line_1, line_2;
  for (int k = 0; k < 4; ++k) {
    line.col(k) = plane.middleCols<4>(4 * k) * value[1];
    line_1.col(k) = plane_1.middleCols<4>(4 * k) * value[1];
    line_2.col(k) = plane.middleCols<4>(4 * k) * slope[1];
  }
  PositionAndJacobian result;
  result.x = line * value[2];
  result.jacobian.col(0) = line_1 * value[2];
  result.jacobian.col(1) = line_2 * value[2];
  result.jacobian.col(2) = line * slope[2];
  return result;
}

}  // namespace mammotwin
