#include "segmentation/chest_wall/settle_wall.h"

#include <cmath>

#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

// More of the disputed rays than this lose their support: 0.06 where the prior mended a real wall,
// 0.38 to 0.62 where it spoilt one.
constexpr double most_lost = 0.15;
// No woman's wall lies this much deeper than others' do (their spread is 6 to 10 mm): the image's
// edge is that of liver, heart or lung, and the thin muscle before it has lung behind, which is as
// dark as suppressed fat.
constexpr double organs_mm = 15, most_lost_before_organs = 0.5;

double unsupported(const PectoralWall& wall, Side side, double z_low, double z_high) {
  return wall.doubt(side, z_low, z_high) + wall.fat_behind(side, z_low, z_high);
}

/// Takes the rays of one side from another wall.
void take_side(const PectoralWall& from, Side side, PectoralWall& wall) {
  for (std::size_t n = 0; n < wall.radius.size(); ++n) {
    const double angle = wall.first_angle + static_cast<double>(n % wall.angles) * wall.angle_step;
    if (side == Side::left ? angle < 0 : angle >= 0) continue;
    wall.radius[n] = from.radius[n];
    wall.cost[n] = from.cost[n];
    wall.behind[n] = from.behind[n];
    wall.contrast[n] = from.contrast[n];
  }
}

}  // namespace

WallDispute wall_dispute(const PectoralWall& chosen, const PectoralWall& other, Side side,
                         double z_low, double z_high) {
  WallDispute found;
  std::vector<double> off;
  std::vector<std::size_t> where;
  const std::vector<std::size_t> rays = chosen.rays_before(side, z_low, z_high);
  for (const std::size_t n : rays) {
    const double by = other.radius[n] - chosen.radius[n];
    if (std::abs(by) <= other_edge_mm) continue;
    off.push_back(by);
    where.push_back(n);
  }
  if (off.empty()) return found;
  found.share = static_cast<double>(off.size()) / static_cast<double>(rays.size());
  found.patch = largest_patch(chosen, where);
  found.median_mm = median(off);
  return found;
}

SettledWall settled_wall(const PectoralWall& by_image, const PectoralWall& with_prior, double z_low,
                         double z_high) {
  SettledWall settled{with_prior, by_image};
  for (const Side side : {Side::left, Side::right}) {
    const WallDispute found = wall_dispute(with_prior, by_image, side, z_low, z_high);
    const double lost =
        unsupported(with_prior, side, z_low, z_high) - unsupported(by_image, side, z_low, z_high);
    const double allowed = found.median_mm < -organs_mm ? most_lost_before_organs : most_lost;
    bool& by_prior = side == Side::left ? settled.left_by_prior : settled.right_by_prior;
    by_prior = found.share > 0 && lost <= allowed * found.share;
    if (by_prior) continue;
    take_side(by_image, side, settled.wall);
    take_side(with_prior, side, settled.other);
  }
  return settled;
}

}  // namespace mammotwin
