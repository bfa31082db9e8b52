#include "fitting/mesh/block_mesh.h"

#include <stdexcept>

namespace mammotwin {

std::vector<HermiteMesh::Corners> grid_corners(const Eigen::Vector3i& n) {
  const auto node = [&](int i, int j, int k) { return i + (n.x() + 1) * (j + (n.y() + 1) * k); };
  std::vector<HermiteMesh::Corners> elements;
  for (int k = 0; k < n.z(); ++k)
    for (int j = 0; j < n.y(); ++j)
      for (int i = 0; i < n.x(); ++i) {
        HermiteMesh::Corners c;
        for (int m = 0; m < 8; ++m) c[m] = node(i + (m & 1), j + (m >> 1 & 1), k + (m >> 2));
        elements.push_back(c);
      }
  return elements;
}

HermiteMesh block_mesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                       const Eigen::Vector3i& n) {
  if (n.minCoeff() < 1) throw std::invalid_argument("block_mesh: needs at least 1 element a side");
  if ((high - low).minCoeff() <= 0)
    throw std::invalid_argument("block_mesh: low must be below high");
  const Eigen::Vector3d size = (high - low).cwiseQuotient(n.cast<double>());
  std::vector<HermiteMesh::Node> nodes;
  for (int k = 0; k <= n.z(); ++k)
    for (int j = 0; j <= n.y(); ++j)
      for (int i = 0; i <= n.x(); ++i) {
        HermiteMesh::Node node = HermiteMesh::Node::Zero();
        node.col(0) = low + size.cwiseProduct(Eigen::Vector3d(i, j, k));
        for (int a = 0; a < 3; ++a) node(a, 1 << a) = size[a];
        nodes.push_back(node);
      }
  return HermiteMesh(std::move(nodes), grid_corners(n));
}

}  // namespace mammotwin
