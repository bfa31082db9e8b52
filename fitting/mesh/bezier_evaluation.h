#pragma once

#include <array>

#include "fitting/mesh/bezier.h"

namespace mammotwin {

/// Position [mm] and Jacobian ∂x/∂ξ [mm] at one point.
struct PositionAndJacobian {
  Eigen::Vector3d x;
  Eigen::Matrix3d jacobian;
};

/// Control points with a fourth row of zeros: two or four numbers are worked on at a time.
using PaddedBezierElement = Eigen::Matrix<double, 4, 64>;

inline PaddedBezierElement padded(const BezierElement& b) {
  PaddedBezierElement p = PaddedBezierElement::Zero();
  p.topRows<3>() = b;
  return p;
}

/// Evaluates an element by sum factorisation of its control points.
inline PositionAndJacobian evaluate(const PaddedBezierElement& b, const Eigen::Vector3d& xi) {
  std::array<std::array<double, 4>, 3> value, slope;
  for (int a = 0; a < 3; ++a) {
    const double t = xi[a], s = 1 - t;
    value[a] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    slope[a] = {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t};
  }
  const auto along = [](const auto& points, int first, int stride, const auto& weights) {
    return (weights[0] * points.col(first) + weights[1] * points.col(first + stride) +
            weights[2] * points.col(first + 2 * stride) +
            weights[3] * points.col(first + 3 * stride))
        .eval();
  };
  // ξ₃ first: its points lie in long runs.
  Eigen::Matrix<double, 4, 16> plane, plane_3;
  for (int m = 0; m < 16; ++m) {
    plane.col(m) = along(b, m, 16, value[2]);
    plane_3.col(m) = along(b, m, 16, slope[2]);
  }
  Eigen::Matrix<double, 4, 4> line, line_2, line_3;
  for (int i = 0; i < 4; ++i) {
    line.col(i) = along(plane, i, 4, value[1]);
    line_2.col(i) = along(plane, i, 4, slope[1]);
    line_3.col(i) = along(plane_3, i, 4, value[1]);
  }
  PositionAndJacobian result;
  result.x = along(line, 0, 1, value[0]).template head<3>();
  result.jacobian.col(0) = along(line, 0, 1, slope[0]).template head<3>();
  result.jacobian.col(1) = along(line_2, 0, 1, value[0]).template head<3>();
  result.jacobian.col(2) = along(line_3, 0, 1, value[0]).template head<3>();
  return result;
}

}  // namespace mammotwin
