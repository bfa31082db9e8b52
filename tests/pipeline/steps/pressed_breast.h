#pragma once

#include <Eigen/Geometry>
#include <numbers>

#include "tests/solver/dome_breast.h"

namespace mammotwin {

/// A breast 70 mm deep and 100 mm high whose sides stand `width_mm` apart in the middle and come
/// nearer by `narrowing` over its depth; turned about the body's axis.
inline MeshFile pressed_breast(double narrowing, double turn_deg, double width_mm = 60) {
  const Eigen::AngleAxisd turn(turn_deg * std::numbers::pi / 180, Eigen::Vector3d::UnitZ());
  MeshFile breast = dome_breast({3, 3, 2});
  breast.mesh = mapped_mesh({3, 3, 2}, [&](const Eigen::Vector3d& xi) {
    const double width = width_mm + narrowing * (0.5 - xi.z());
    return (turn * Eigen::Vector3d(width * (xi.x() - 0.5), -70 * xi.z(), 100 * xi.y())).eval();
  });
  for (FaceLabels& faces : breast.faces)
    for (const int side : {0, 1})
      if (faces[side] == FaceLabel::cut) faces[side] = FaceLabel::skin;
  return breast;
}

}  // namespace mammotwin
