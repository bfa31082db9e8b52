#include "segmentation/chest_wall/steady_wall.h"

#include <algorithm>
#include <cstddef>

#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

/// Index of the wall with the middle radius on one ray; of the first of equals.
std::size_t middle_of(const std::vector<PectoralWall>& walls, std::size_t ray) {
  std::vector<std::size_t> order(walls.size());
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return walls[a].radius[ray] < walls[b].radius[ray];
  });
  return order[order.size() / 2];
}

double spread_of(const std::vector<PectoralWall>& walls, std::size_t ray) {
  double low = walls.front().radius[ray], high = low;
  for (const PectoralWall& wall : walls)
    low = std::min(low, wall.radius[ray]), high = std::max(high, wall.radius[ray]);
  return high - low;
}

}  // namespace

PectoralWall middle_wall(const std::vector<PectoralWall>& walls) {
  PectoralWall middle = walls.front();
  for (std::size_t ray = 0; ray < middle.radius.size(); ++ray) {
    const PectoralWall& from = walls[middle_of(walls, ray)];
    middle.radius[ray] = from.radius[ray];
    middle.cost[ray] = from.cost[ray];
    middle.behind[ray] = from.behind[ray];
    middle.contrast[ray] = from.contrast[ray];
  }
  return middle;
}

WallFlips wall_flips(const std::vector<PectoralWall>& walls, const PectoralWall& middle, Side side,
                     double z_low, double z_high) {
  std::vector<double> spreads;
  std::vector<std::size_t> where;
  const std::vector<std::size_t> rays = middle.rays_before(side, z_low, z_high);
  for (const std::size_t ray : rays) {
    const double spread = spread_of(walls, ray);
    if (spread <= other_edge_mm) continue;
    spreads.push_back(spread);
    where.push_back(ray);
  }
  if (where.empty()) return {};
  return {static_cast<double>(where.size()) / static_cast<double>(rays.size()), median(spreads),
          largest_patch(middle, where)};
}

}  // namespace mammotwin
