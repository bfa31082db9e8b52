#pragma once

#include <random>

#include "fitting/mesh/block_mesh.h"

namespace mammotwin {

/// A box of elements of about 10 mm whose nodal parameters are all disturbed by up to
/// `amount` [mm]; the same at every call.
inline HermiteMesh distorted_mesh(const Eigen::Vector3i& elements, double amount) {
  const HermiteMesh box =
      block_mesh(Eigen::Vector3d(-3, 2, 1),
                 Eigen::Vector3d(-3, 2, 1) + 10 * elements.cast<double>(), elements);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(-amount, amount);
  std::vector<HermiteMesh::Node> nodes = box.nodes();
  for (auto& node : nodes)
    for (int d = 0; d < 8; ++d)
      for (int a = 0; a < 3; ++a) node(a, d) += uniform(random);
  return HermiteMesh(nodes, box.elements());
}

}  // namespace mammotwin
