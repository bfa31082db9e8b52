#include "fitting/mesh/hermite_mesh.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "fitting/mesh/hermite_basis.h"

namespace mammotwin {

namespace {

void check_corners(const std::vector<HermiteMesh::Corners>& elements, int num_nodes) {
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (int corner : elements[e])
      if (corner < 0 || corner >= num_nodes)
        throw std::invalid_argument("element " + std::to_string(e) + " names node " +
                                    std::to_string(corner) + "; expected 0 to " +
                                    std::to_string(num_nodes - 1));
}

}  // namespace

HermiteMesh::HermiteMesh(std::vector<Node> nodes, std::vector<Corners> elements)
    : nodes_(std::move(nodes)), elements_(std::move(elements)) {
  check_corners(elements_, num_nodes());
}

HermiteMesh::Weights HermiteMesh::weights(const Eigen::Vector3d& xi,
                                          const std::array<int, 3>& orders) {
  const HermiteValues h1 = hermite_derivatives(xi[0], orders[0]);
  const HermiteValues h2 = hermite_derivatives(xi[1], orders[1]);
  const HermiteValues h3 = hermite_derivatives(xi[2], orders[2]);
  Weights w;
  for (int n = 0; n < 8; ++n)
    for (int d = 0; d < 8; ++d)
      w(n, d) =
          h1[2 * (n & 1) + (d & 1)] * h2[(n & 2) + (d >> 1 & 1)] * h3[2 * (n >> 2) + (d >> 2)];
  return w;
}

HermiteMesh::Weights HermiteMesh::weights(const Eigen::Vector3d& xi) {
  return weights(xi, {0, 0, 0});
}

Eigen::Vector3d HermiteMesh::interpolate(int element, const Weights& weights) const {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int n = 0; n < 8; ++n) x += nodes_[elements_[element][n]] * weights.row(n).transpose();
  return x;
}

Eigen::Vector3d HermiteMesh::position(const MeshPoint& p) const {
  return interpolate(p.element, weights(p.xi));
}

Eigen::Matrix3d HermiteMesh::jacobian(const MeshPoint& p) const {
  Eigen::Matrix3d j;
  for (int i = 0; i < 3; ++i) {
    std::array<int, 3> orders{0, 0, 0};
    orders[i] = 1;
    j.col(i) = interpolate(p.element, weights(p.xi, orders));
  }
  return j;
}

std::vector<HermiteMesh::Node> combined(double a, const std::vector<HermiteMesh::Node>& x, double b,
                                        const std::vector<HermiteMesh::Node>& y) {
  std::vector<HermiteMesh::Node> sum = x;
  for (std::size_t i = 0; i < x.size(); ++i) sum[i] = a * x[i] + b * y[i];
  return sum;
}

}  // namespace mammotwin
