#pragma once

#include <array>
#include <vector>

#include "fitting/mesh/hermite_mesh.h"
#include "pipeline/validation/lagrange/lagrange_element.h"

namespace mammotwin {

/// Places closer than 1e-3 mm have one key; an offset keeps round lengths off a boundary.
std::array<long, 3> place_key(const Eigen::Vector3d& x);

/// A mesh of Lagrange elements over the elements of a Hermite mesh, its nodes on that mesh.
struct LagrangeMesh {
  LagrangeMesh(const HermiteMesh& shape, const LagrangeElement& element);

  LagrangeElement element;
  std::vector<Eigen::Vector3d> X;          ///< nodes [mm]
  std::vector<std::vector<int>> elements;  ///< nodes of each

  /// The same shape, for positions x of the nodes, as a Hermite mesh whose elements have nodes of
  /// their own: 8 e + corner.
  HermiteMesh broken(const std::vector<Eigen::Vector3d>& x) const;
};

}  // namespace mammotwin
