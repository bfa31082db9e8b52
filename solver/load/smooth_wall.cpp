#include "solver/load/smooth_wall.h"

#include <Eigen/SparseCholesky>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "fitting/mesh/hermite_basis.h"
#include "solver/element/gauss.h"
#include "solver/load/wall_surface.h"

namespace mammotwin {

namespace {

using NodeParameter = std::pair<int, int>;

/// The faces' free parameters, numbered; each holds for all three components.
class WallParameters {
 public:
  explicit WallParameters(const std::vector<ParameterTie>& ties) {
    for (const ParameterTie& tie : ties)
      ties_[{tie.node, tie.parameter}] = {{tie.to_node, tie.to_parameter}, tie.factor};
  }
  struct Free {
    int number;
    double factor;  ///< the parameter is this times the free one
  };
  Free of(NodeParameter parameter) {
    double factor = 1;
    for (auto tie = ties_.find(parameter); tie != ties_.end(); tie = ties_.find(parameter)) {
      factor *= tie->second.second;
      parameter = tie->second.first;
    }
    const auto [found, is_new] = numbers_.try_emplace(parameter, static_cast<int>(order_.size()));
    if (is_new) order_.push_back(parameter);
    return {found->second, factor};
  }
  const std::vector<NodeParameter>& order() const { return order_; }

 private:
  std::map<NodeParameter, std::pair<NodeParameter, double>> ties_;
  std::map<NodeParameter, int> numbers_;
  std::vector<NodeParameter> order_;
};

using PatchMatrix = Eigen::Matrix<double, 16, 16>;

/// ∫ N Nᵀ and ℓ⁴ ∫ (N,₁₁ N,₁₁ᵀ + 2 N,₁₂ N,₁₂ᵀ + N,₂₂ N,₂₂ᵀ) of a patch whose sides are `size` long.
struct PatchEnergy {
  PatchMatrix mass = PatchMatrix::Zero(), bending = PatchMatrix::Zero();
};

PatchEnergy patch_energy(const Eigen::Vector2d& size, double length) {
  const GaussRule rule = gauss_rule(4);
  PatchEnergy energy;
  for (std::size_t i = 0; i < rule.points.size(); ++i)
    for (std::size_t j = 0; j < rule.points.size(); ++j) {
      const auto shape = [&](int order1, int order2) {
        const HermiteValues h = hermite_derivatives(rule.points[i], order1),
                            g = hermite_derivatives(rule.points[j], order2);
        Eigen::Matrix<double, 16, 1> values;
        for (int a = 0; a < 16; ++a) values[a] = h[a & 3] * g[a >> 2];
        return (values / (std::pow(size[0], order1) * std::pow(size[1], order2))).eval();
      };
      const double area = rule.weights[i] * rule.weights[j] * size.prod();
      const auto add = [](const Eigen::Matrix<double, 16, 1>& n, double weight, PatchMatrix& sum) {
        sum += weight * n * n.transpose();
      };
      const double stiff = area * std::pow(length, 4);
      add(shape(0, 0), area, energy.mass);
      add(shape(2, 0), stiff, energy.bending);
      add(shape(1, 1), 2 * stiff, energy.bending);
      add(shape(0, 2), stiff, energy.bending);
    }
  return energy;
}

/// Mean lengths of a patch's opposite sides [mm].
Eigen::Vector2d patch_size(const Eigen::Matrix<double, 3, 16>& c) {
  const auto corner = [&](int i, int j) { return c.col(2 * i + 8 * j); };
  return {((corner(1, 0) - corner(0, 0)).norm() + (corner(1, 1) - corner(0, 1)).norm()) / 2,
          ((corner(0, 1) - corner(0, 0)).norm() + (corner(1, 1) - corner(1, 0)).norm()) / 2};
}

}  // namespace

HermiteMesh with_smooth_wall(const HermiteMesh& mesh, const std::vector<ParameterTie>& ties,
                             const std::vector<std::pair<int, int>>& faces, double length) {
  WallParameters parameters(ties);
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<std::pair<int, Eigen::RowVector3d>> loads;
  for (const auto& [element, face] : faces) {
    std::array<WallParameters::Free, 16> free{};
    for (int a = 0; a < 16; ++a) free[a] = parameters.of(face_parameter(mesh, element, face, a));
    const Eigen::Matrix<double, 3, 16> c = face_coefficients(mesh, element, face);
    const PatchEnergy energy = patch_energy(patch_size(c), length);
    const Eigen::Matrix<double, 16, 3> load = energy.mass * c.transpose();
    for (int a = 0; a < 16; ++a) {
      loads.push_back({free[a].number, free[a].factor * load.row(a)});
      for (int b = 0; b < 16; ++b)
        entries.emplace_back(
            free[a].number, free[b].number,
            free[a].factor * free[b].factor * (energy.mass(a, b) + energy.bending(a, b)));
    }
  }
  const int count = static_cast<int>(parameters.order().size());
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
  for (const auto& [row, load] : loads) right.row(row) += load;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success)
    throw std::runtime_error("the chest wall of the mesh cannot be smoothed: a face has no size");
  const Eigen::MatrixX3d smooth = solver.solve(right);
  std::vector<HermiteMesh::Node> nodes = mesh.nodes();
  for (const auto& [element, face] : faces)
    for (int a = 0; a < 16; ++a) {
      const NodeParameter at = face_parameter(mesh, element, face, a);
      const WallParameters::Free free = parameters.of(at);
      nodes[at.first].col(at.second) = free.factor * smooth.row(free.number).transpose();
    }
  return HermiteMesh(nodes, mesh.elements());
}

}  // namespace mammotwin
