#pragma once

#include <vector>

namespace mammotwin {

/// Elimination order of `num_nodes` nodes that are coupled within each clique: METIS nested
/// dissection through CHOLMOD. Deterministic.
std::vector<int> nested_dissection(int num_nodes, const std::vector<std::vector<int>>& cliques);

}  // namespace mammotwin
