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

}  // namespace

std::vector<int> nested_dissection(int num_nodes, const std::vector<std::vector<int>>& cliques) {
  cholmod_common common;
  cholmod_start(&common);
  cholmod_sparse* A = lower_pattern(neighbours(num_nodes, cliques), common);
  std::vector<int> order(num_nodes);
  const bool done = [&] {
    static std::mutex metis;  // draws from the process's one sequence of random numbers
    const std::lock_guard lock(metis);
    return cholmod_metis(A, nullptr, 0, 1, order.data(), &common) != 0;
  }();
  cholmod_free_sparse(&A, &common);
  cholmod_finish(&common);
  if (!done) throw std::runtime_error("METIS could not order the mesh's nodes");
  return order;
}

}  // namespace mammotwin
