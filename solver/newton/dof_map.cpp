#include "solver/newton/dof_map.h"

#include <algorithm>
#include <set>

#include "solver/newton/model.h"
#include "solver/newton/nested_dissection.h"

namespace mammotwin {

DofMap::DofMap(const HermiteMesh& mesh)
    : leader_(24 * mesh.num_nodes()),
      link_factor_(leader_.size(), 1),
      prescribed_(leader_.size(), 0) {
  for (std::size_t i = 0; i < leader_.size(); ++i) leader_[i] = static_cast<int>(i);
}

DofMap::Class DofMap::find(int dof) const {
  double factor = 1;
  while (leader_[dof] != dof) {
    factor *= link_factor_[dof];
    dof = leader_[dof];
  }
  return {dof, factor};
}

void DofMap::prescribe(int dof) { prescribed_[find(dof).leader] = 1; }

void DofMap::tie(int follower, int leader, double factor) {
  const Class f = find(follower), l = find(leader);
  if (f.leader == l.leader) return;
  leader_[f.leader] = l.leader;
  link_factor_[f.leader] = factor * l.factor / f.factor;
  prescribed_[l.leader] |= prescribed_[f.leader];
}

void DofMap::number(const HermiteMesh& mesh) {
  std::vector<int> owner(num_dofs());
  for (int dof = 0; dof < num_dofs(); ++dof) owner[dof] = find(dof).leader / 24;
  std::vector<std::vector<int>> cliques;  // owners of an element's unknowns
  for (const auto& corners : mesh.elements()) {
    std::set<int> nodes;
    for (int node : corners)
      for (int k = 0; k < 24; ++k) nodes.insert(owner[24 * node + k]);
    cliques.emplace_back(nodes.begin(), nodes.end());
  }
  equation_.assign(num_dofs(), -1);
  factor_.assign(num_dofs(), 1);
  node_of_equation_.clear();
  for (int node : nested_dissection(mesh.num_nodes(), cliques))
    for (int dof = 24 * node; dof < 24 * node + 24; ++dof)
      if (leader_[dof] == dof && !prescribed_[dof]) {
        equation_[dof] = static_cast<int>(node_of_equation_.size());
        node_of_equation_.push_back(node);
      }
  num_equations_ = static_cast<int>(node_of_equation_.size());
  for (int dof = 0; dof < num_dofs(); ++dof) {
    const Class c = find(dof);
    equation_[dof] = equation_[c.leader];
    factor_[dof] = c.factor;
  }
}

std::vector<int> face_dofs(const HermiteMesh& mesh, int element, int face, int component) {
  const int direction = face / 2;
  std::vector<int> dofs;
  for (int corner = 0; corner < 8; ++corner) {
    if ((corner >> direction & 1) != face % 2) continue;
    for (int parameter = 0; parameter < 8; ++parameter)
      if (!(parameter >> direction & 1))
        dofs.push_back(dof_index(mesh.corners(element)[corner], parameter, component));
  }
  return dofs;
}

}  // namespace mammotwin
