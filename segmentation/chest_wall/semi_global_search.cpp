#include "segmentation/chest_wall/semi_global_search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace mammotwin {
namespace {

struct Grid {
  int rows, columns, depths;
  std::size_t at(int row, int column) const {
    return (static_cast<std::size_t>(row) * columns + column) * depths;
  }
  bool contains(int row, int column) const {
    return row >= 0 && column >= 0 && row < rows && column < columns;
  }
};

/// One step of a path: cheapest way to each depth from the step before.
void advance(const float* cost, const float* before, float* here, int depths, float stiffness,
             int max_jump) {
  const float lowest = *std::min_element(before, before + depths);
  for (int d = 0; d < depths; ++d) {
    float best = 1e30F;
    for (int e = std::max(0, d - max_jump); e <= std::min(depths - 1, d + max_jump); ++e)
      best = std::min(best, before[e] + stiffness * static_cast<float>((d - e) * (d - e)));
    here[d] = cost[d] + best - lowest;
  }
}

std::vector<float> along_paths(const std::vector<float>& cost, const Grid& grid, int step_row,
                               int step_column, double stiffness, int max_jump) {
  std::vector<float> path(cost.size());
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) {
      const int row = step_row >= 0 ? r : grid.rows - 1 - r;
      const int column = step_column >= 0 ? c : grid.columns - 1 - c;
      const std::size_t here = grid.at(row, column);
      if (!grid.contains(row - step_row, column - step_column)) {
        std::copy_n(cost.begin() + here, grid.depths, path.begin() + here);
        continue;
      }
      advance(&cost[here], &path[grid.at(row - step_row, column - step_column)], &path[here],
              grid.depths, static_cast<float>(stiffness), max_jump);
    }
  return path;
}

double lowest_depth(const float* sum, int depths) {
  const int d = static_cast<int>(std::min_element(sum, sum + depths) - sum);
  if (d == 0 || d == depths - 1) return d;
  const double bend = sum[d - 1] - 2.0 * sum[d] + sum[d + 1];
  return bend > 0 ? d + 0.5 * (sum[d - 1] - sum[d + 1]) / bend : d;
}

}  // namespace

std::vector<double> semi_global_search(const std::vector<float>& cost, int rows, int columns,
                                       int depths, double stiffness, int max_jump) {
  const Grid grid{rows, columns, depths};
  constexpr std::array<std::array<int, 2>, 8> directions{
      {{0, 1}, {0, -1}, {1, 0}, {-1, 0}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
  std::array<std::vector<float>, directions.size()> paths;
  tbb::parallel_for(std::size_t{0}, directions.size(), [&](std::size_t n) {
    paths[n] = along_paths(cost, grid, directions[n][0], directions[n][1], stiffness, max_jump);
  });
  std::vector<float> sum(cost.size(), 0);
  for (const std::vector<float>& path : paths)
    for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += path[n];
  std::vector<double> depth;
  for (int n = 0; n < rows * columns; ++n)
    depth.push_back(lowest_depth(&sum[static_cast<std::size_t>(n) * depths], depths));
  return depth;
}

}  // namespace mammotwin
