#pragma once

#include <array>
#include <vector>

#include "fitting/mesh/hermite_mesh.h"

namespace mammotwin {

/// Control points of one element in tri-cubic Bernstein form: column i + 4(j + 4k) [mm].
/// The element lies in their convex hull.
using BezierElement = Eigen::Matrix<double, 3, 64>;

/// Along each ξ: b₀ = p₀, b₁ = p₀ + p₀′/3, b₂ = p₁ − p₁′/3, b₃ = p₁.
BezierElement bezier_element(const HermiteMesh& mesh, int element);

/// The control points of a whole mesh, those on faces between elements that share nodes once.
struct BezierMesh {
  /// Control point = node ± its derivatives / 3; sign[i] is −1, 0 or 1 along ξᵢ₊₁.
  struct Point {
    int node;
    std::array<int, 3> sign;
  };
  std::vector<Point> points;
  std::vector<std::array<int, 64>> elements;  ///< point index at i + 4(j + 4k)

  explicit BezierMesh(const HermiteMesh& mesh);

  /// Control values of a field given by Hermite parameters at the mesh's nodes.
  static Eigen::Vector3d value(const HermiteMesh::Node& node, const std::array<int, 3>& sign);
};

/// Control values that interpolate `values` at ξ = 0, 1/3, 2/3, 1 along each direction;
/// entry i + 4(j + 4k) of both belongs to (i, j, k).
std::array<double, 64> bezier_from_samples(const std::array<double, 64>& values);

}  // namespace mammotwin
