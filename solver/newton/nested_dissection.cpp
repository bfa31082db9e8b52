#include "solver/newton/nested_dissection.h"

#include <suitesparse/cholmod.h>

#include <mutex>
#include <set>
#include <stdexcept>

namespace mammotwin {

namespace {

std::vector<std::set<int>> neighbours(int num_nodes, const std::vector<std::vector<int>>& cliques) {
  std::vector<std::set<int>> graph(num_nodes);
  for (const auto& clique : cliques)
    for (int column : clique)
      for (int row : clique)
        if (row > column) graph[column].insert(row);
  return graph;
}

cholmod_sparse* lower_pattern(const std::vector<std::set<int>>& graph, cholmod_common& common) {
  std::size_t entries = 0;
  for (const auto& rows : graph) entries += rows.size();
  const std::size_t n = graph.size();
  cholmod_sparse* A = cholmod_allocate_sparse(n, n, entries, 1, 1, -1, CHOLMOD_PATTERN, &common);
  auto* starts = static_cast<int*>(A->p);
  auto* indices = static_cast<int*>(A->i);
  int k = 0;
  for (std::size_t column = 0; column < n; ++column) {
    starts[column] = k;
    for (int row : graph[column]) indices[k++] = row;
  }
  starts[n] = k;
  return A;
}

/// METIS dissects to the last node; CHOLMOD's own dissection ends at parts of `nd_small` nodes and
/// orders within and between them by least degree (CSYMAMD). Which makes the sparser factor hangs
/// on the mesh: for 9 x 9 x 2 elements the parts of 200 nodes (2.99 Gflop; METIS 4.15), for 12 x
/// 12 x 3 those of 30 (18.7; METIS 21.4).
void try_several(cholmod_common& common) {
  constexpr int csymamd = 2;
  constexpr std::size_t parts[] = {30, 100, 200};
  common.supernodal = CHOLMOD_SIMPLICIAL;  // no more than the order is asked of the analysis
  common.method[0].ordering = CHOLMOD_METIS;
  common.nmethods = 1;
  for (const std::size_t part : parts) {
    auto& method = common.method[common.nmethods++];
    method.ordering = CHOLMOD_NESDIS;
    method.nd_small = part;
    method.nd_camd = csymamd;
  }
}

}  // namespace

std::vector<int> nested_dissection(int num_nodes, const std::vector<std::vector<int>>& cliques) {
  cholmod_common common;
  cholmod_start(&common);
  try_several(common);
  cholmod_sparse* A = lower_pattern(neighbours(num_nodes, cliques), common);
  cholmod_factor* factor = [&] {
    static std::mutex metis;  // draws from the process's one sequence of random numbers
    const std::lock_guard lock(metis);
    return cholmod_analyze(A, &common);
  }();
  std::vector<int> order;
  if (factor) {
    const int* permutation = static_cast<const int*>(factor->Perm);
    order.assign(permutation, permutation + num_nodes);
  }
  cholmod_free_factor(&factor, &common);
  cholmod_free_sparse(&A, &common);
  cholmod_finish(&common);
  if (order.empty()) throw std::runtime_error("CHOLMOD could not order the mesh's nodes");
  return order;
}

}  // namespace mammotwin
