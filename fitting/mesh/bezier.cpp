#include "fitting/mesh/bezier.h"

#include <Eigen/LU>
#include <map>
#include <tuple>

namespace mammotwin {

namespace {

/// Control point i of a direction belongs to this end ...
constexpr std::array<int, 4> end_of = {0, 0, 1, 1};
/// ... displaced along that end's derivative with this sign.
constexpr std::array<int, 4> sign_of = {0, 1, -1, 0};

BezierMesh::Point control_point(const HermiteMesh::Corners& corners, int i, int j, int k) {
  return {corners[end_of[i] + 2 * end_of[j] + 4 * end_of[k]], {sign_of[i], sign_of[j], sign_of[k]}};
}

/// Row a holds the four cubic Bernstein polynomials at a/3.
Eigen::Matrix4d bernstein_at_thirds() {
  Eigen::Matrix4d b;
  for (int a = 0; a < 4; ++a) {
    const double t = a / 3.0, s = 1 - t;
    b.row(a) << s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t;
  }
  return b;
}

}  // namespace

Eigen::Vector3d BezierMesh::value(const HermiteMesh::Node& node, const std::array<int, 3>& sign) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int d = 0; d < 8; ++d) {
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis)
      if (d >> axis & 1) weight *= sign[axis] / 3.0;
    x += weight * node.col(d);
  }
  return x;
}

BezierElement bezier_element(const HermiteMesh& mesh, int element) {
  BezierElement b;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        const BezierMesh::Point p = control_point(mesh.corners(element), i, j, k);
        b.col(i + 4 * (j + 4 * k)) = BezierMesh::value(mesh.node(p.node), p.sign);
      }
  return b;
}

BezierMesh::BezierMesh(const HermiteMesh& mesh) {
  std::map<std::pair<int, std::array<int, 3>>, int> index;
  for (const auto& corners : mesh.elements()) {
    std::array<int, 64>& element = elements.emplace_back();
    for (int m = 0; m < 64; ++m) {
      const Point p = control_point(corners, m % 4, m / 4 % 4, m / 16);
      const auto [at, is_new] =
          index.try_emplace({p.node, p.sign}, static_cast<int>(points.size()));
      if (is_new) points.push_back(p);
      element[m] = at->second;
    }
  }
}

std::array<double, 64> bezier_from_samples(const std::array<double, 64>& values) {
  static const Eigen::Matrix4d inverse = bernstein_at_thirds().inverse();
  std::array<double, 64> control = values;
  for (int stride : {1, 4, 16})
    for (int start = 0; start < 64; ++start) {
      if (start / stride % 4 != 0) continue;
      Eigen::Vector4d line;
      for (int a = 0; a < 4; ++a) line[a] = control[start + a * stride];
      line = inverse * line;
      for (int a = 0; a < 4; ++a) control[start + a * stride] = line[a];
    }
  return control;
}

}  // namespace mammotwin
