#include "solver/newton/nested_dissection.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace mammotwin {
namespace {

/// A box of n³ nodes in cells of eight.
std::vector<std::vector<int>> cells(int n) {
  std::vector<std::vector<int>> cliques;
  for (int k = 0; k + 1 < n; ++k)
    for (int j = 0; j + 1 < n; ++j)
      for (int i = 0; i + 1 < n; ++i) {
        std::vector<int> clique;
        for (int c = 0; c < 8; ++c)
          clique.push_back(i + (c & 1) + n * (j + (c >> 1 & 1) + n * (k + (c >> 2))));
        cliques.push_back(std::move(clique));
      }
  return cliques;
}

TEST(NestedDissection, OrdersAlikeWhateverOtherThreadsOrder) {
  constexpr int n = 8, threads = 4, orderings = 12;
  const auto cliques = cells(n);
  const std::vector<int> alone = nested_dissection(n * n * n, cliques);
  std::atomic<int> others = 0;
  std::vector<std::thread> workers;
  for (int t = 0; t < threads; ++t)
    workers.emplace_back([&] {
      for (int i = 0; i < orderings; ++i)
        if (nested_dissection(n * n * n, cliques) != alone) ++others;
    });
  for (std::thread& worker : workers) worker.join();
  EXPECT_EQ(others, 0);
}

}  // namespace
}  // namespace mammotwin
