#include "segmentation/chest_wall/pectoral_wall.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "segmentation/chest_wall/drawn_wall.h"
#include "segmentation/chest_wall/polar_rays.h"
#include "segmentation/chest_wall/semi_global_search.h"
#include "segmentation/chest_wall/wall_contrast.h"
#include "segmentation/chest_wall/wall_cost.h"
#include "segmentation/chest_wall/wall_prior.h"
#include "segmentation/chest_wall/wall_refinement.h"
#include "segmentation/image/order_statistics.h"
#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double widest_degrees = 90, step_degrees = 1.5;
constexpr double row_mm = 2, axis_behind_mm = 110, beyond_slices_mm = 25;
constexpr int max_jump_mm = 4;

/// Mean brightness 2 to 5 mm behind the wall, of each ray: clear of the edge's blur, and still in
/// the thin muscle below the breast.
std::vector<float> brightness_behind(const PectoralWall& wall, const Volume<float>& image) {
  constexpr int from_mm = 2, to_mm = 5;
  std::vector<float> behind;
  for (std::size_t n = 0; n < wall.radius.size(); ++n) {
    float sum = 0;
    for (int d = from_mm; d <= to_mm; ++d)
      sum += interpolated(image, wall.position(n, wall.radius[n] - d));
    behind.push_back(sum / (to_mm - from_mm + 1));
  }
  return behind;
}

/// Median of the 3 x 3 around each point: single rays cannot step out.
std::vector<double> median_filtered(const std::vector<double>& map, int rows, int columns) {
  std::vector<double> out(map.size());
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      std::vector<double> near;
      for (int b = std::max(0, r - 1); b <= std::min(rows - 1, r + 1); ++b)
        for (int a = std::max(0, c - 1); a <= std::min(columns - 1, c + 1); ++a)
          near.push_back(map[static_cast<std::size_t>(b) * columns + a]);
      out[static_cast<std::size_t>(r) * columns + c] = median(near);
    }
  return out;
}

/// Of some rays in all that are in question; all, where there are none but drawn ones.
double share_of(const std::vector<std::size_t>& some, const std::vector<std::size_t>& all,
                bool any_drawn) {
  if (all.empty()) return any_drawn ? 0 : 1;
  return static_cast<double>(some.size()) / static_cast<double>(all.size());
}

/// Holds a wall to what was drawn, as near as that is known.
void hold_to(const std::vector<UsualRadius>& drawn, PectoralWall& wall) {
  for (std::size_t n = 0; n < drawn.size(); ++n) {
    const UsualRadius& at = drawn[n];
    wall.drawn.push_back(at.spread > 0);
    if (at.spread > 0)
      wall.radius[n] = std::clamp(wall.radius[n], at.mean - at.spread, at.mean + at.spread);
  }
}

struct FoundDepths {
  std::vector<double> depth;  ///< [samples], between two of them
  std::vector<float> cost;    ///< there
};

/// The prior decides where the wall is; support is what the image alone says of it.
FoundDepths search(const PolarRays& rays, const std::vector<WallContrast>& contrasts,
                   const std::vector<UsualRadius>& usual, double stiffness) {
  const std::vector<float> cost = wall_costs(rays, contrasts);
  std::vector<float> with_prior = cost;
  add_prior(usual, with_prior);
  FoundDepths found;
  found.depth = semi_global_search(with_prior, rays.rows, rays.angles, PolarRays::depths, stiffness,
                                   max_jump_mm);
  found.depth = median_filtered(found.depth, rays.rows, rays.angles);
  for (std::size_t n = 0; n < found.depth.size(); ++n) {
    const auto at = static_cast<std::size_t>(std::lround(found.depth[n]));
    found.cost.push_back(cost[n * PolarRays::depths + at]);
    found.depth[n] -= 0.5;  // the cost at d is that of a wall between the samples d - 1 and d
  }
  return found;
}

}  // namespace

PectoralWall wall_grid(const Volume<float>& image, const BreastFrame& frame) {
  PectoralWall wall;
  wall.axis_x = frame.midline_x;
  wall.axis_y = frame.sternal_y + axis_behind_mm;
  wall.first_angle = -widest_degrees * degree;
  wall.angle_step = step_degrees * degree;
  wall.angles = static_cast<int>(std::lround(2 * widest_degrees / step_degrees)) + 1;
  const double top = image.position(0, 0, image.size.z() - 1).z();
  const double low = std::max(image.origin.z(), frame.z_low - beyond_slices_mm);
  const double high = std::min(top, frame.z_high + beyond_slices_mm);
  wall.first_z = low;
  wall.z_step = row_mm;
  wall.rows = std::max(1, static_cast<int>((high - low) / row_mm) + 1);
  return wall;
}

PectoralWall find_pectoral_wall(const Volume<float>& corrected, const Volume<std::uint8_t>& body,
                                const BreastFrame& frame, const WallContrast& contrast,
                                double stiffness, const std::vector<UsualRadius>& usual,
                                const std::vector<UsualRadius>& drawn) {
  PectoralWall wall = wall_grid(corrected, frame);
  const PolarRays rays = cast_rays(corrected, body, wall);
  std::vector<WallContrast> contrasts(rays.exit.size(), contrast);
  const std::vector<UsualRadius> beforehand = with_drawn(usual, drawn);
  FoundDepths found = search(rays, contrasts, beforehand, stiffness);
  constexpr int rounds = 2;  // a wall that stood on gland is on muscle in the first
  for (int round = 0; round < rounds; ++round) {
    contrasts = local_contrasts(rays, found.depth, found.cost, contrast);
    found = search(rays, contrasts, beforehand, stiffness);
  }
  wall.cost = found.cost;
  wall.contrast = contrasts;
  for (const double d : refined_depths(rays, found.depth, contrasts))
    wall.radius.push_back(PolarRays::least_radius_mm + d);
  hold_to(drawn, wall);
  wall.behind = brightness_behind(wall, corrected);
  return wall;
}

Eigen::Vector3d PectoralWall::position(std::size_t ray, double radius_mm) const {
  const double theta = first_angle + static_cast<double>(ray % angles) * angle_step;
  const double z = first_z + static_cast<double>(ray / angles) * z_step;
  return {axis_x + radius_mm * std::sin(theta), axis_y - radius_mm * std::cos(theta), z};
}

bool PectoralWall::is_behind(const Eigen::Vector3d& x_in_lps) const {
  const double dx = x_in_lps.x() - axis_x, dy = axis_y - x_in_lps.y();
  const double a = std::clamp((std::atan2(dx, dy) - first_angle) / angle_step, 0.0, angles - 1.0);
  const double b = std::clamp((x_in_lps.z() - first_z) / z_step, 0.0, rows - 1.0);
  const int a0 = std::min(static_cast<int>(a), std::max(0, angles - 2));
  const int b0 = std::min(static_cast<int>(b), std::max(0, rows - 2));
  const int a1 = std::min(a0 + 1, angles - 1), b1 = std::min(b0 + 1, rows - 1);
  const double s = a - a0, t = b - b0;
  const auto r = [&](int row, int angle) {
    return radius[static_cast<std::size_t>(row) * angles + angle];
  };
  const double here =
      (1 - t) * ((1 - s) * r(b0, a0) + s * r(b0, a1)) + t * ((1 - s) * r(b1, a0) + s * r(b1, a1));
  return dx * dx + dy * dy < here * here;
}

std::vector<std::size_t> PectoralWall::rays_before(Side side, double z_low, double z_high,
                                                   double from_degrees) const {
  constexpr double front_degrees = 50;
  std::vector<std::size_t> rays;
  for (int row = 0; row < rows; ++row)
    for (int a = 0; a < angles; ++a) {
      const double angle = first_angle + a * angle_step, z = first_z + row * z_step;
      const double outward = side == Side::left ? angle : -angle;
      if (outward < from_degrees * degree || outward > front_degrees * degree || z < z_low ||
          z > z_high)
        continue;
      const std::size_t ray = static_cast<std::size_t>(row) * angles + a;
      if (drawn.empty() || !drawn[ray]) rays.push_back(ray);
    }
  return rays;
}

std::vector<std::size_t> PectoralWall::unsupported(Side side, double z_low, double z_high) const {
  constexpr double supported = -0.5;
  std::vector<std::size_t> rays = rays_before(side, z_low, z_high);
  std::erase_if(rays, [&](std::size_t n) { return cost[n] <= supported; });
  return rays;
}

double PectoralWall::doubt(Side side, double z_low, double z_high) const {
  return share_of(unsupported(side, z_low, z_high), rays_before(side, z_low, z_high),
                  !drawn.empty());
}

std::vector<std::size_t> PectoralWall::before_fat(Side side, double z_low, double z_high) const {
  constexpr float least = 0.02F;  // noise can leave nothing of a value
  std::vector<std::size_t> rays = rays_before(side, z_low, z_high, breastbone_degrees);
  std::erase_if(rays, [&](std::size_t n) {
    const double value = std::log(std::max(behind[n], least));
    const double middle = (std::log(contrast[n].fat) + std::log(contrast[n].muscle)) / 2;
    return contrast[n].muscle > contrast[n].fat ? value >= middle : value <= middle;
  });
  return rays;
}

double PectoralWall::fat_behind(Side side, double z_low, double z_high) const {
  return share_of(before_fat(side, z_low, z_high),
                  rays_before(side, z_low, z_high, breastbone_degrees), !drawn.empty());
}

}  // namespace mammotwin
