#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/newton/dof_map.h"
#include "solver/newton/stretch.h"

namespace mammotwin {

/// Lower triangle of the tangent, column by column, and where each element's entries go in it.
struct SparsePattern {
  std::vector<int> starts, rows;

  /// Per element: equation (or -1) of each of its 192 unknowns (layout: tensor_basis.h), and what
  /// the equation's increment is multiplied by to give the unknown's.
  std::vector<std::vector<int>> equations;
  std::vector<std::vector<double>> factors;

  /// Per element: its unknowns that have an equation, in the equations' order, and where the lower
  /// triangle of its matrix goes, so ordered: column by column, from its rows to the values.
  std::vector<std::vector<int>> unknowns;
  std::vector<std::vector<Stretch>> stretches;

  /// Elements of one colour share no equation, so they can be added at the same time and the sum's
  /// order does not depend on threads.
  std::vector<std::vector<int>> colours;

  int num_columns() const { return static_cast<int>(starts.size()) - 1; }

  /// Adds `scale` times an element's vector, by unknowns, to one by equations.
  void add(int e, const Eigen::Ref<const Eigen::VectorXd>& of_element, double scale,
           Eigen::VectorXd& sum) const;
};

SparsePattern make_sparse_pattern(const HermiteMesh& mesh, const DofMap& dofs);

/// Product of the symmetric matrix with these values.
Eigen::VectorXd multiply(const SparsePattern& pattern, const std::vector<double>& values,
                         const Eigen::VectorXd& x);

}  // namespace mammotwin
