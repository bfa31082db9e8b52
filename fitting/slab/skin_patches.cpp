#include "fitting/slab/skin_patches.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "fitting/mesh/bezier.h"

namespace mammotwin {

SkinPatches::SkinPatches(const Slab& slab, const HermiteMesh& mesh) : slab_(slab) {
  for (int j = 0; j < slab.elements.y(); ++j)
    for (int i = 0; i < slab.elements.x(); ++i)
      patches_.push_back(
          bezier_element(mesh, slab.element(i, j, slab.elements.z() - 1)).rightCols<16>());
}

Eigen::Vector3d SkinPatches::Point::normal() const { return by_s.cross(by_t).normalized(); }

MeshPoint SkinPatches::mesh_point(const Coordinates& st) const {
  const int i = std::clamp(static_cast<int>(st.x()), 0, slab_.elements.x() - 1);
  const int j = std::clamp(static_cast<int>(st.y()), 0, slab_.elements.y() - 1);
  return {slab_.element(i, j, slab_.elements.z() - 1), {st.x() - i, st.y() - j, 1}};
}

SkinPatches::Point SkinPatches::at(const Coordinates& st) const {
  const int i = std::clamp(static_cast<int>(st.x()), 0, slab_.elements.x() - 1);
  const int j = std::clamp(static_cast<int>(st.y()), 0, slab_.elements.y() - 1);
  std::array<Eigen::Vector4d, 2> value, slope;
  for (int a = 0; a < 2; ++a) {
    const double t = st[a] - (a ? j : i), s = 1 - t;
    value[a] << s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t;
    slope[a] << -3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t;
  }
  const auto& b = patches_[i + slab_.elements.x() * j];
  Eigen::Matrix<double, 3, 4> line, line_s;
  for (int m = 0; m < 4; ++m) {
    line.col(m) = b.middleCols<4>(4 * m) * value[0];
    line_s.col(m) = b.middleCols<4>(4 * m) * slope[0];
  }
  return {line * value[1], line_s * value[1], line * slope[1]};
}

SkinPatches::Coordinates SkinPatches::nearest(const Eigen::Vector3d& x, Coordinates st,
                                              int held) const {
  constexpr int max_steps = 20;
  constexpr double smallest_step = 1e-7;  // of an element
  const Eigen::Vector2d high(slab_.elements.x(), slab_.elements.y());
  Point here = at(st);
  double squared_distance = (x - here.x).squaredNorm();
  for (int step = 0; step < max_steps; ++step) {
    const Eigen::Vector3d r = x - here.x;
    Eigen::Vector2d slope(here.by_s.dot(r), here.by_t.dot(r));
    Eigen::Matrix2d normal;
    normal << here.by_s.squaredNorm(), here.by_s.dot(here.by_t), here.by_s.dot(here.by_t),
        here.by_t.squaredNorm();
    for (int a = 0; a < 2; ++a)
      if (a == held || (st[a] <= 0 && slope[a] < 0) || (st[a] >= high[a] && slope[a] > 0)) {
        normal.row(a).setZero();
        normal.col(a).setZero();
        normal(a, a) = 1;
        slope[a] = 0;
      }
    const Eigen::Vector2d move = normal.inverse() * slope;
    bool moved = false;
    for (double part = 1; part > 1e-2 && !moved; part /= 4) {
      const Coordinates trial = (st + part * move).cwiseMax(0).cwiseMin(high);
      const Point there = at(trial);
      const double d = (x - there.x).squaredNorm();
      if (d >= squared_distance) continue;
      moved = (trial - st).norm() > smallest_step;
      st = trial;
      here = there;
      squared_distance = d;
    }
    if (!moved) break;
  }
  return st;
}

}  // namespace mammotwin
