#pragma once

#include <vector>

#include "fitting/mesh/hermite_mesh.h"

namespace mammotwin {

/// From nodal parameters to equations: which are prescribed, which are tied to another.
///
/// dof = dof_index(node, parameter, component). An equation moves every dof of its class by the
/// same increment, up to a factor.
class DofMap {
 public:
  explicit DofMap(const HermiteMesh& mesh);

  /// The dof keeps the value that the state gives it.
  void prescribe(int dof);

  /// Increment of `follower` = factor * increment of `leader`: nodes that stand at one place
  /// (ParameterTie of a mesh file). factor is not 0.
  void tie(int follower, int leader, double factor);

  /// Numbers the equations: nested dissection on the nodes, all unknowns of a node
  /// together.
  void number(const HermiteMesh& mesh);

  int num_dofs() const { return static_cast<int>(leader_.size()); }
  int num_equations() const { return num_equations_; }
  int equation(int dof) const { return equation_[dof]; }  ///< -1: prescribed
  double factor(int dof) const { return factor_[dof]; }
  bool prescribed(int dof) const { return equation_[dof] < 0; }

  /// Node whose unknown the equation is.
  const std::vector<int>& node_of_equation() const { return node_of_equation_; }

 private:
  struct Class {
    int leader;
    double factor;
  };
  Class find(int dof) const;

  std::vector<int> leader_;
  std::vector<double> link_factor_;
  std::vector<char> prescribed_;
  std::vector<int> equation_, node_of_equation_;
  std::vector<double> factor_;
  int num_equations_ = 0;
};

/// dofs of component i that a face carries: holding them holds x_i on all of the face where the
/// face lies in a plane x_i = constant and its lines do too.
std::vector<int> face_dofs(const HermiteMesh& mesh, int element, int face, int component);

}  // namespace mammotwin
