#include "fitting/mesh/inverse_map.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <stdexcept>

namespace mammotwin {

namespace {

using Eigen::Vector3d;

constexpr int parts_a_side = 4;  // small enough that Newton from a part's centre converges
constexpr int parts_in_leaf = 4;
constexpr int most_levels = 32;       // each halves the parts, of which an int can count so many
constexpr int max_newton_steps = 30;  // distorted elements need up to 8
constexpr double position_tolerance = 1e-9;  // [mm]
constexpr double last_step = 1e-5;           // [mm]: a step from here leads to within a billionth
constexpr double xi_tolerance = 1e-9;        // points on faces belong to the mesh despite rounding

/// Rows turn four control values into those of part `index` of `count` equal parts.
Eigen::Matrix4d restriction(int index, int count) {
  const double u0 = static_cast<double>(index) / count, u1 = static_cast<double>(index + 1) / count;
  // Blossom: control value i of the part takes u1 i times and u0 3 − i times.
  Eigen::Matrix4d r;
  for (int i = 0; i < 4; ++i) {
    Eigen::Matrix4d v = Eigen::Matrix4d::Identity();
    for (int step = 0; step < 3; ++step) {
      const double t = step < i ? u1 : u0;
      for (int a = 0; a + step < 3; ++a) v.row(a) = (1 - t) * v.row(a) + t * v.row(a + 1);
    }
    r.row(i) = v.row(0);
  }
  return r;
}

/// Bounding box of the control points of part (p, q, r).
Eigen::AlignedBox3d part_box(const BezierElement& b, const std::array<Eigen::Matrix4d, 3>& cut) {
  Eigen::Matrix<double, 3, 64> x = b, y;
  for (int m = 0; m < 16; ++m) y.middleCols<4>(4 * m) = x.middleCols<4>(4 * m) * cut[0].transpose();
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        x.col(i + 4 * j + 16 * k).setZero();
        for (int a = 0; a < 4; ++a)
          x.col(i + 4 * j + 16 * k) += cut[1](j, a) * y.col(i + 4 * a + 16 * k);
      }
  Eigen::AlignedBox3d box;
  for (int m = 0; m < 16; ++m)
    for (int k = 0; k < 4; ++k) {
      Vector3d p = Vector3d::Zero();
      for (int a = 0; a < 4; ++a) p += cut[2](k, a) * x.col(m + 16 * a);
      box.extend(p);
    }
  const double slack = position_tolerance;
  return {box.min() - Vector3d::Constant(slack), box.max() + Vector3d::Constant(slack)};
}

bool in_unit_cube(const Vector3d& xi) {
  return xi.minCoeff() >= -xi_tolerance && xi.maxCoeff() <= 1 + xi_tolerance;
}

Vector3d clamp(const Vector3d& xi, double low, double high) {
  return xi.cwiseMax(low).cwiseMin(high);
}

}  // namespace

InverseMap::InverseMap(const HermiteMesh& mesh) {
  if (mesh.num_elements() == 0) throw std::invalid_argument("InverseMap: the mesh has no element");
  for (int e = 0; e < mesh.num_elements(); ++e) {
    const BezierElement element = bezier_element(mesh, e);
    elements_.push_back(padded(element));
    for (int part = 0; part < parts_a_side * parts_a_side * parts_a_side; ++part) {
      const Eigen::Vector3i at(part % parts_a_side, part / parts_a_side % parts_a_side,
                               part / (parts_a_side * parts_a_side));
      const std::array<Eigen::Matrix4d, 3> cut = {restriction(at[0], parts_a_side),
                                                  restriction(at[1], parts_a_side),
                                                  restriction(at[2], parts_a_side)};
      parts_.push_back({e, (at.cast<double>() + Vector3d::Constant(0.5)) / parts_a_side,
                        part_box(element, cut)});
    }
  }
  build(0, static_cast<int>(parts_.size()));
}

int InverseMap::build(int first, int last) {
  const int index = static_cast<int>(branches_.size());
  Branch branch{{}, first, last};
  for (int i = first; i < last; ++i) branch.box.extend(parts_[i].box);
  branches_.push_back(branch);
  if (last - first <= parts_in_leaf) return index;
  int axis;
  branch.box.sizes().maxCoeff(&axis);
  const int middle = (first + last) / 2;
  std::nth_element(
      parts_.begin() + first, parts_.begin() + middle, parts_.begin() + last,
      [axis](const Part& a, const Part& b) { return a.box.center()[axis] < b.box.center()[axis]; });
  const int left = build(first, middle), right = build(middle, last);
  branches_[index].left = left;
  branches_[index].right = right;
  return index;
}

/// Ends where the continued element would hold x outside its faces: as soon as two steps in turn
/// lead as far out as they may.
std::optional<MeshPoint> InverseMap::newton(const Vector3d& x, MeshPoint p) const {
  bool at_limit = false;
  for (int step = 0; step < max_newton_steps; ++step) {
    const PositionAndJacobian at = evaluate(elements_[p.element], p.xi);
    const Vector3d residual = x - at.x;
    const Vector3d dxi = at.jacobian.inverse() * residual;
    if (!dxi.allFinite()) return std::nullopt;
    // Half an element beyond the faces the cubic continuation means nothing any more.
    p.xi = clamp(p.xi + clamp(dxi, -0.5, 0.5), -0.5, 1.5);
    if (residual.norm() < last_step) {
      if (!in_unit_cube(p.xi)) return std::nullopt;
      p.xi = clamp(p.xi, 0, 1);
      return p;
    }
    const bool again = p.xi.minCoeff() <= -0.5 || p.xi.maxCoeff() >= 1.5;
    if (again && at_limit) return std::nullopt;
    at_limit = again;
  }
  return std::nullopt;
}

std::optional<MeshPoint> InverseMap::locate(const Vector3d& x, const MeshPoint& guess) const {
  if (const auto found = newton(x, guess)) return found;
  return locate(x);
}

std::optional<MeshPoint> InverseMap::locate(const Vector3d& x) const {
  std::array<int, most_levels + 1> stack = {0};
  for (int waiting = 1; waiting > 0;) {
    const Branch& branch = branches_[stack[--waiting]];
    if (!branch.box.contains(x)) continue;
    if (branch.left >= 0) {
      stack[waiting++] = branch.right;
      stack[waiting++] = branch.left;
      continue;
    }
    for (int i = branch.first; i < branch.last; ++i)
      if (parts_[i].box.contains(x))
        if (const auto found = newton(x, {parts_[i].element, parts_[i].centre})) return found;
  }
  return std::nullopt;
}

double InverseMap::descend(const Vector3d& x, MeshPoint& p) const {
  PositionAndJacobian at = evaluate(elements_[p.element], p.xi);
  double squared_distance = (x - at.x).squaredNorm();
  for (int step = 0; step < max_newton_steps; ++step) {
    const Vector3d slope = at.jacobian.transpose() * (x - at.x);
    Eigen::Matrix3d normal = at.jacobian.transpose() * at.jacobian;
    Vector3d direction = slope;
    for (int a = 0; a < 3; ++a)
      if ((p.xi[a] <= 0 && slope[a] < 0) || (p.xi[a] >= 1 && slope[a] > 0)) {
        normal.row(a).setZero();
        normal.col(a).setZero();
        normal(a, a) = 1;
        direction[a] = 0;
      }
    const Vector3d dxi = normal.inverse() * direction;
    if ((clamp(p.xi + dxi, 0, 1) - p.xi).norm() < xi_tolerance) break;
    bool moved = false;
    for (double part = 1; part > 1e-3 && !moved; part /= 2) {
      const MeshPoint trial{p.element, clamp(p.xi + part * dxi, 0, 1)};
      const PositionAndJacobian there = evaluate(elements_[p.element], trial.xi);
      const double d = (x - there.x).squaredNorm();
      if (d < squared_distance) {
        moved = true;
        p = trial;
        at = there;
        squared_distance = d;
      }
    }
    if (!moved) break;
  }
  return squared_distance;
}

MeshPoint InverseMap::nearest(const Vector3d& x) const {
  if (const auto inside = locate(x)) return *inside;
  MeshPoint best{0, Vector3d::Zero()};
  double best_squared = std::numeric_limits<double>::infinity();
  using Entry = std::pair<double, int>;  // squared distance to the box, branch
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.push({branches_[0].box.squaredExteriorDistance(x), 0});
  while (!queue.empty() && queue.top().first < best_squared) {
    const Branch& branch = branches_[queue.top().second];
    queue.pop();
    if (branch.left >= 0) {
      for (int child : {branch.left, branch.right})
        queue.push({branches_[child].box.squaredExteriorDistance(x), child});
      continue;
    }
    for (int i = branch.first; i < branch.last; ++i) {
      if (parts_[i].box.squaredExteriorDistance(x) >= best_squared) continue;
      MeshPoint p{parts_[i].element, parts_[i].centre};
      const double d = descend(x, p);
      if (d < best_squared) {
        best_squared = d;
        best = p;
      }
    }
  }
  return best;
}

}  // namespace mammotwin
