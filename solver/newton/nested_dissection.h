#pragma once

#include <vector>

namespace mammotwin {

/// Elimination order of `num_nodes` nodes that are coupled within each clique: of several nested
/// dissections by CHOLMOD (METIS's separators) the one whose factor has the fewest entries.
/// Deterministic.
std::vector<int> nested_dissection(int num_nodes, const std::vector<std::vector<int>>& cliques);

}  // namespace mammotwin
