#pragma once

#include <Eigen/Core>
#include <array>

#include "fitting/mesh/hermite_mesh.h"

namespace mammotwin {

inline constexpr int element_size = 192;  ///< parameters: 24·corner + 3·parameter + component
using ElementVector = Eigen::Matrix<double, element_size, 1>;
using ElementMatrix = Eigen::MatrixXd;  ///< element_size squared

/// An element's parameters: column 8·corner + parameter. Its memory is an ElementVector's.
using ElementShape = Eigen::Matrix<double, 3, 64>;

/// Of the nodes, with positions taken from `origin` for rounding's sake.
inline ElementShape element_shape(const std::vector<HermiteMesh::Node>& nodes,
                                  const HermiteMesh::Corners& corners,
                                  const Eigen::Vector3d& origin) {
  ElementShape shape;
  for (int n = 0; n < 8; ++n) {
    shape.middleCols<8>(8 * n) = nodes[corners[n]];
    shape.col(8 * n) -= origin;
  }
  return shape;
}

using BasisRow = Eigen::Matrix<double, 1, 64>;

/// Values at ξ of the basis functions, differentiated order[i] times along ξᵢ₊₁.
inline BasisRow basis_row(const Eigen::Vector3d& xi, const std::array<int, 3>& order = {0, 0, 0}) {
  const HermiteMesh::Weights w = HermiteMesh::weights(xi, order);
  BasisRow row;
  for (int n = 0; n < 8; ++n) row.segment<8>(8 * n) = w.row(n);
  return row;
}

/// Gradient and Gauss-Newton Hessian of one element's part of the cost.
struct ElementQuadratic {
  ElementVector gradient = ElementVector::Zero();
  ElementMatrix hessian = ElementMatrix::Zero(element_size, element_size);
};

}  // namespace mammotwin
