#pragma once

#include "fitting/mesh/hermite_mesh.h"

namespace mammotwin {

/// Box [low, high] [mm] in a regular grid of elements; ξ₁, ξ₂, ξ₃ run along x, y, z and
/// elements and nodes are numbered with ξ₁ fastest.
/// Throws std::invalid_argument unless every count is at least 1 and low < high.
HermiteMesh block_mesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                       const Eigen::Vector3i& elements);

/// Corner nodes of a regular grid of elements over (n₁+1)(n₂+1)(n₃+1) nodes, ξ₁ fastest.
std::vector<HermiteMesh::Corners> grid_corners(const Eigen::Vector3i& elements);

}  // namespace mammotwin
