#pragma once

#include <vector>

#include "solver/newton/sparse_pattern.h"
#include "solver/newton/stretch.h"

namespace mammotwin {

/// A dense piece of a multifrontal factorisation: the equations eliminated here ("pivots"), and
/// those that they couple to, which an ancestor eliminates.
struct Front {
  int num_pivots = 0;
  std::vector<int> equations;  ///< pivots first; in elimination order
  std::vector<int> children;   ///< fronts whose update this one adds, in this order

  std::vector<int> to_parent;                ///< place in the parent's equations of each non-pivot
  std::vector<Stretch> stretches_to_parent;  ///< the same

  /// Entries of the matrix that start here, pivot by pivot: from the values to rows of the panel;
  /// those of pivot p are [starts[p], starts[p + 1]).
  std::vector<int> starts;
  std::vector<Stretch> entries;

  int size() const { return static_cast<int>(equations.size()); }
};

/// Elimination tree of a matrix whose equations are already in a fill-reducing order: node by node
/// structures, merged where that costs few zeros. Children come before parents; roots have none.
struct FrontTree {
  std::vector<Front> fronts;
  std::vector<int> roots;
  double flops() const;  ///< multiplications and additions of one factorisation
};

/// `node_of_equation`: equations of one node are neighbours and share a structure.
FrontTree make_front_tree(const SparsePattern& pattern, const std::vector<int>& node_of_equation);

}  // namespace mammotwin
