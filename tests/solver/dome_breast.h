#pragma once

#include <algorithm>
#include <cmath>

#include "fitting/mesh/mesh_file.h"
#include "solver/press/compress.h"
#include "tests/solver/test_meshes.h"

namespace mammotwin {

/// A breast as the fit makes them: a slab over a chest wall of radius 150 mm (about the z axis),
/// with a dome of 55 mm on 8 mm of tissue, cut at the sides. x lateral, y posterior, z superior.
inline MeshFile dome_breast(const Eigen::Vector3i& elements = {6, 6, 2}) {
  constexpr double half_side = 70, rim = 8, height = 55, foot = 66, wall_radius = 150;
  const auto map = [](const Eigen::Vector3d& xi) {
    const double x = half_side * (2 * xi.x() - 1), z = half_side * (2 * xi.y() - 1);
    const double r = std::min(1.0, std::hypot(x, z) / foot);
    const double dome = std::pow(std::cos(1.5707963267948966 * r), 2);
    const double wall = wall_radius - std::sqrt(wall_radius * wall_radius - x * x);
    // The dome is drawn out a little, as a hanging breast is: its foot is narrower than its middle.
    const double pull = 1 + 0.1 * xi.z() * dome;
    return Eigen::Vector3d(pull * x, wall - xi.z() * (rim + height * dome), pull * z);
  };
  MeshFile file{mapped_mesh(elements, map), {}, {}, {}, {}, {}};
  for (int k = 0; k < elements.z(); ++k)
    for (int j = 0; j < elements.y(); ++j)
      for (int i = 0; i < elements.x(); ++i) {
        FaceLabels labels;
        labels.fill(FaceLabel::interior);
        if (i == 0) labels[0] = FaceLabel::cut;
        if (i == elements.x() - 1) labels[1] = FaceLabel::cut;
        if (j == 0) labels[2] = FaceLabel::cut;
        if (j == elements.y() - 1) labels[3] = FaceLabel::cut;
        if (k == 0) labels[4] = FaceLabel::chest_wall;
        if (k == elements.z() - 1) labels[5] = FaceLabel::skin;
        file.faces.push_back(labels);
      }
  return file;
}

/// Fat with smooth fibroglandular lumps of 36 mm period; `lumps` false: fat alone.
inline TissueSampler lumpy_tissue(bool lumps = true) {
  return [lumps](const Eigen::Vector3d& x, double) -> std::array<double, 3> {
    const auto wave = [](double t) { return std::sin(2 * 3.14159265358979 * t / 36); };
    const double s = wave(x.x()) * wave(x.y() + 9) * wave(x.z());
    const double f = lumps ? std::clamp(0.5 + 2 * s, 0.0, 1.0) : 0;
    return {1 - f, f, 0};
  };
}

inline CompressionProblem dome_problem(double thickness, bool lumps = true) {
  CompressionProblem problem;
  problem.mesh = dome_breast();
  problem.tissue = lumpy_tissue(lumps);
  problem.plates.thickness = thickness;
  return problem;
}

}  // namespace mammotwin
