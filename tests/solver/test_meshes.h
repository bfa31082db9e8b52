#pragma once

#include <functional>
#include <random>

#include "fitting/mesh/hermite_mesh.h"
#include "solver/newton/dof_map.h"
#include "solver/newton/model.h"

namespace mammotwin {

/// Box [0, size] in a regular grid of elements, written out here so that the solver's tests need
/// nothing but the mesh type.
inline HermiteMesh box_mesh(const Eigen::Vector3d& size, const Eigen::Vector3i& n) {
  const Eigen::Vector3d h = size.cwiseQuotient(n.cast<double>());
  std::vector<HermiteMesh::Node> nodes;
  for (int k = 0; k <= n.z(); ++k)
    for (int j = 0; j <= n.y(); ++j)
      for (int i = 0; i <= n.x(); ++i) {
        HermiteMesh::Node node = HermiteMesh::Node::Zero();
        node.col(0) = h.cwiseProduct(Eigen::Vector3d(i, j, k));
        for (int a = 0; a < 3; ++a) node(a, 1 << a) = h[a];
        nodes.push_back(node);
      }
  std::vector<HermiteMesh::Corners> elements;
  const auto id = [&](int i, int j, int k) { return i + (n.x() + 1) * (j + (n.y() + 1) * k); };
  for (int k = 0; k < n.z(); ++k)
    for (int j = 0; j < n.y(); ++j)
      for (int i = 0; i < n.x(); ++i) {
        HermiteMesh::Corners c;
        for (int m = 0; m < 8; ++m) c[m] = id(i + (m & 1), j + (m >> 1 & 1), k + (m >> 2));
        elements.push_back(c);
      }
  return HermiteMesh(std::move(nodes), std::move(elements));
}

/// The mesh with every nodal parameter moved at random by up to `amount` [mm].
inline HermiteMesh distorted(const HermiteMesh& mesh, double amount, unsigned seed) {
  std::mt19937 random(seed);
  auto nodes = mesh.nodes();
  for (auto& node : nodes)
    for (int k = 0; k < 24; ++k) node(k) += amount * (2 * (random() / 4294967295.0) - 1);
  return HermiteMesh(nodes, mesh.elements());
}

/// The mesh carried by a quadratic map that shears, bends and twists it by up to `amount` [mm].
/// Hermite elements follow it exactly, and 4 Gauss points integrate its patch test exactly.
inline HermiteMesh bent(const HermiteMesh& mesh, double amount) {
  const double size = mesh.nodes().back().col(0).maxCoeff();
  const double c = amount / (size * size);
  auto nodes = mesh.nodes();
  const auto product = [](const HermiteMesh::Node& X, int i, int j) {  // parameters of X_i X_j
    Eigen::Matrix<double, 1, 8> p = Eigen::Matrix<double, 1, 8>::Zero();
    for (int d = 0; d < 8; ++d)
      for (int part = 0; part < 8; ++part)
        if ((part & d) == part) p[d] += X(i, part) * X(j, d & ~part);
    return p;
  };
  for (auto& node : nodes) {
    const HermiteMesh::Node X = node;
    node.row(0) += c * (product(X, 1, 1) - product(X, 1, 2));
    node.row(1) += c * (product(X, 0, 2) + product(X, 2, 2));
    node.row(2) += c * (product(X, 0, 1) - product(X, 0, 0));
  }
  return HermiteMesh(nodes, mesh.elements());
}

/// Nodes of the mesh carried by an affine map, which Hermite parameters follow exactly.
inline std::vector<HermiteMesh::Node> affine(const HermiteMesh& mesh, const Eigen::Matrix3d& F,
                                             const Eigen::Vector3d& shift) {
  auto nodes = mesh.nodes();
  for (auto& node : nodes) {
    node = (F * node).eval();
    node.col(0) += shift;
  }
  return nodes;
}

/// A grid of elements over the unit cube carried by a smooth map: nodal derivatives by nested
/// central differences, good to 1e-4 of their size.
inline HermiteMesh mapped_mesh(const Eigen::Vector3i& n,
                               const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) {
  constexpr double h = 1e-3;
  const HermiteMesh unit = box_mesh({1, 1, 1}, n);
  auto nodes = unit.nodes();
  for (int i = 0; i < unit.num_nodes(); ++i)
    for (int d = 0; d < 8; ++d) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double scale = 1;
      for (int k = 0; k < 3; ++k)
        if (d >> k & 1) scale /= 2 * h * n[k];
      for (int s = 0; s < 8; ++s) {
        if (s & ~d) continue;
        Eigen::Vector3d xi = unit.node(i).col(0);
        double sign = 1;
        for (int k = 0; k < 3; ++k)
          if (d >> k & 1) {
            xi[k] += s >> k & 1 ? -h : h;
            sign *= s >> k & 1 ? -1 : 1;
          }
        sum += sign * map(xi);
      }
      nodes[i].col(d) = scale * sum;
    }
  return HermiteMesh(nodes, unit.elements());
}

/// (element, face) pairs whose face lies in the plane x_axis = value.
inline std::vector<std::pair<int, int>> faces_at(const HermiteMesh& mesh, int axis, double value,
                                                 double tolerance = 1e-9) {
  std::vector<std::pair<int, int>> faces;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face) {
      bool inside = true;
      for (int c = 0; c < 8; ++c)
        if ((c >> (face / 2) & 1) == face % 2)
          inside &= std::abs(mesh.node(mesh.corners(e)[c])(axis, 0) - value) < tolerance;
      if (inside) faces.push_back({e, face});
    }
  return faces;
}

inline void hold_plane(const HermiteMesh& mesh, int axis, double value, DofMap& dofs) {
  for (const auto& [e, face] : faces_at(mesh, axis, value))
    for (int dof : face_dofs(mesh, e, face, axis)) dofs.prescribe(dof);
}

inline std::function<Eigen::Vector3d(const Eigen::Vector3d&)> uniform_force(
    const Eigen::Vector3d& force) {
  return [force](const Eigen::Vector3d&) { return force; };
}

inline Model::MaterialField uniform(std::shared_ptr<const Material> material) {
  return [material](const Eigen::Vector3d&, double) { return material; };
}

}  // namespace mammotwin
