#include "segmentation/chest_wall/wall_patch.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "segmentation/image/components.h"

namespace mammotwin {
namespace {

constexpr double mm2_per_cm2 = 100;

}  // namespace

double WallPatch::radius_mm() const { return std::sqrt(area_cm2 * mm2_per_cm2 / std::numbers::pi); }

WallPatch largest_patch(const PectoralWall& wall, const std::vector<std::size_t>& rays) {
  Volume<std::uint8_t> in({wall.angles, wall.rows, 1}, Eigen::Vector3d::Ones(),
                          Eigen::Vector3d::Zero(), 0);
  for (const std::size_t n : rays) in.values[n] = 1;
  const Components parts = connected_components(in);
  const std::int32_t largest = parts.largest();
  WallPatch patch;
  if (largest == 0) return patch;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double mm2 = 0;
  for (const std::size_t n : rays) {
    if (parts.ids.values[n] != largest) continue;
    sum += wall.position(n, wall.radius[n]);
    mm2 += wall.radius[n] * wall.angle_step * wall.z_step;
  }
  patch.area_cm2 = mm2 / mm2_per_cm2;
  const Eigen::Vector3d mean = sum / static_cast<double>(parts.sizes[largest]);
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::size_t n : rays) {
    if (parts.ids.values[n] != largest) continue;
    const Eigen::Vector3d x = wall.position(n, wall.radius[n]);
    if (const double away = (x - mean).norm(); away < nearest)
      nearest = away, patch.middle_in_lps = x;
  }
  return patch;
}

}  // namespace mammotwin
