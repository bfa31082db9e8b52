#include "pipeline/validation/lagrange/lagrange_mesh.h"

#include <array>
#include <cmath>
#include <map>

namespace mammotwin {

std::array<long, 3> place_key(const Eigen::Vector3d& x) {
  constexpr double same = 1e-3, offset = 0.37e-3;
  return {std::lround((x[0] + offset) / same), std::lround((x[1] + offset) / same),
          std::lround((x[2] + offset) / same)};
}

LagrangeMesh::LagrangeMesh(const HermiteMesh& shape, const LagrangeElement& e) : element(e) {
  std::map<std::array<long, 3>, int> index;
  for (int e = 0; e < shape.num_elements(); ++e) {
    auto& nodes = elements.emplace_back();
    for (int n = 0; n < element.num_nodes(); ++n) {
      const Eigen::Vector3d place = shape.position({e, element.xi(n)});
      const auto [found, is_new] = index.try_emplace(place_key(place), static_cast<int>(X.size()));
      if (is_new) X.push_back(place);
      nodes.push_back(found->second);
    }
  }
}

HermiteMesh LagrangeMesh::broken(const std::vector<Eigen::Vector3d>& x) const {
  std::vector<HermiteMesh::Node> nodes(8 * elements.size());
  std::vector<HermiteMesh::Corners> corners;
  Eigen::MatrixXd q(element.num_nodes(), 3);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    for (int n = 0; n < element.num_nodes(); ++n) q.row(n) = x[elements[e][n]];
    const Eigen::MatrixXd c = element.coefficients_from_nodes() * q;
    for (int a = 0; a < kFunctions; ++a)
      nodes[8 * e + corner_of_function(a)].col(parameter_of_function(a)) = c.row(a).transpose();
    auto& own = corners.emplace_back();
    for (int k = 0; k < 8; ++k) own[k] = static_cast<int>(8 * e) + k;
  }
  return HermiteMesh(std::move(nodes), std::move(corners));
}

}  // namespace mammotwin
