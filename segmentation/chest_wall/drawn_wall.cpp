#include "segmentation/chest_wall/drawn_wall.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace mammotwin {
namespace {

constexpr double kHand_mm = 0.7;  // a pixel
constexpr double kSpreadAway = 0.1;
constexpr double kFarthestAngle = 20 * std::numbers::pi / 180, kFarthestHeight_mm = 60;
constexpr double kWeight = 30;  // of the image's edges, which weigh 3

/// A point's angle in steps of the grid, and its radius.
using OnRow = std::vector<std::pair<double, double>>;

std::runtime_error off_the_wall(const Eigen::Vector3d& x) {
  char place[80];
  std::snprintf(place, sizeof place, "[%.1f, %.1f, %.1f]", x.x(), x.y(), x.z());
  return std::runtime_error(std::string("the chest wall drawn has a point at ") + place +
                            ", where no chest wall can be; expected points on the muscle's front, "
                            "in LPS [mm], in slices of the breasts");
}

std::map<int, OnRow> by_rows(const PectoralWall& grid, const std::vector<Eigen::Vector3d>& points) {
  std::map<int, OnRow> rows;
  for (const Eigen::Vector3d& x : points) {
    const double dx = x.x() - grid.axis_x, dy = grid.axis_y - x.y(), radius = std::hypot(dx, dy);
    const double angle = (std::atan2(dx, dy) - grid.first_angle) / grid.angle_step;
    const int row = static_cast<int>(std::lround((x.z() - grid.first_z) / grid.z_step));
    if (angle < 0 || angle > grid.angles - 1 || radius < PolarRays::least_radius_mm ||
        radius > PolarRays::least_radius_mm + PolarRays::depths - 1)
      throw off_the_wall(x);
    if (row >= 0 && row < grid.rows) rows[row].emplace_back(angle, radius);
  }
  if (rows.empty()) throw off_the_wall(points.front());
  for (auto& [row, line] : rows) std::sort(line.begin(), line.end());
  return rows;
}

/// Between two points of a row, or half a ray beside one; 0 elsewhere.
double radius_on(const OnRow& line, double angle, double farthest) {
  constexpr double beside = 0.5;
  const auto next = std::lower_bound(line.begin(), line.end(), std::pair(angle, 0.0));
  if (next != line.end() && next != line.begin()) {
    const auto last = std::prev(next);
    const double apart = next->first - last->first;
    if (apart <= farthest) {
      const double share = apart > 0 ? (angle - last->first) / apart : 0;
      return (1 - share) * last->second + share * next->second;
    }
  }
  if (next != line.end() && next->first - angle <= beside) return next->second;
  if (next != line.begin() && angle - std::prev(next)->first <= beside)
    return std::prev(next)->second;
  return 0;
}

UsualRadius drawn(double radius, double away_mm) {
  return {radius, std::hypot(kHand_mm, kSpreadAway * away_mm), kWeight};
}

/// One angle, over the rows in which it is drawn. A row beside these is held, too: a slice lies
/// between two rows.
void fill_angle(const PectoralWall& grid, int angle, const std::map<int, double>& radii,
                std::vector<UsualRadius>& rays) {
  const auto hold = [&](int row, double radius, int rows_away) {
    if (row < 0 || row >= grid.rows) return;
    rays[static_cast<std::size_t>(row) * grid.angles + angle] =
        drawn(radius, rows_away * grid.z_step);
  };
  for (const auto& [row, radius] : radii)
    for (const int beside : {-1, 1}) hold(row + beside, radius, 1);
  for (auto low = radii.begin(); low != radii.end(); ++low) {
    hold(low->first, low->second, 0);
    const auto high = std::next(low);
    if (high == radii.end() || (high->first - low->first) * grid.z_step > kFarthestHeight_mm)
      continue;
    for (int row = low->first + 1; row < high->first; ++row) {
      const double share = static_cast<double>(row - low->first) / (high->first - low->first);
      hold(row, (1 - share) * low->second + share * high->second,
           std::min(row - low->first, high->first - row));
    }
  }
}

}  // namespace

std::vector<UsualRadius> drawn_radii(const PectoralWall& grid,
                                     const std::vector<Eigen::Vector3d>& points_in_lps) {
  if (points_in_lps.empty()) return {};
  const std::map<int, OnRow> rows = by_rows(grid, points_in_lps);
  std::vector<UsualRadius> rays(static_cast<std::size_t>(grid.rows) * grid.angles);
  for (int angle = 0; angle < grid.angles; ++angle) {
    std::map<int, double> radii;
    for (const auto& [row, line] : rows)
      if (const double radius = radius_on(line, angle, kFarthestAngle / grid.angle_step);
          radius > 0)
        radii.emplace(row, radius);
    fill_angle(grid, angle, radii, rays);
  }
  return rays;
}

std::vector<UsualRadius> with_drawn(std::vector<UsualRadius> usual,
                                    const std::vector<UsualRadius>& drawn) {
  if (usual.empty()) return drawn;
  for (std::size_t n = 0; n < drawn.size(); ++n)
    if (drawn[n].spread > 0) usual[n] = drawn[n];
  return usual;
}

}  // namespace mammotwin
