#include "segmentation/chest_wall/wall_prior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mammotwin {
namespace {

constexpr int num_heights = 12, num_angles = 7;
constexpr double first_height_mm = -120, height_step_mm = 20;
constexpr double angle_step = 10 * std::numbers::pi / 180;
constexpr double grid_mm = 3;         // what a ray 10 degrees on may differ by
constexpr double breastbone_mm = 12;  // its thickness, by which maps and images differ there
constexpr double breastbone_angle = 15 * std::numbers::pi / 180;

using Table = std::array<std::array<double, num_angles>, num_heights>;
// Rows from 120 mm below the apices to 100 mm above, columns from 0 to 60 degrees; 7 to 20 values
// in each cell. WallPrior.IsThatOfTheLabelMaps computes them again.
constexpr Table means{{{84.3, 86.4, 93.7, 106.4, 119.4, 135.0, 146.9},
                       {85.4, 87.8, 96.4, 105.7, 117.1, 130.4, 141.1},
                       {84.6, 88.3, 95.8, 105.2, 115.2, 125.8, 135.7},
                       {85.1, 89.4, 96.2, 104.8, 114.7, 122.2, 131.4},
                       {87.3, 92.3, 100.2, 107.7, 114.4, 119.7, 129.9},
                       {89.5, 94.1, 101.7, 108.9, 114.6, 116.9, 128.4},
                       {88.3, 92.1, 100.1, 108.7, 114.5, 114.6, 125.1},
                       {84.7, 88.0, 95.8, 104.3, 114.3, 116.1, 121.1},
                       {80.6, 84.6, 90.1, 96.6, 110.7, 118.5, 119.4},
                       {72.8, 75.9, 80.5, 85.9, 98.3, 115.4, 121.0},
                       {67.4, 70.0, 74.3, 79.7, 87.0, 102.8, 122.9},
                       {63.0, 65.6, 69.1, 75.4, 82.9, 95.0, 121.1}}};
constexpr Table spreads{{{6.5, 6.9, 7.7, 7.5, 6.8, 5.5, 8.9},
                         {5.7, 6.9, 7.0, 6.7, 6.0, 5.1, 6.3},
                         {4.7, 6.3, 8.2, 6.6, 5.2, 6.3, 6.7},
                         {5.8, 6.8, 6.7, 6.3, 5.2, 6.0, 7.3},
                         {7.4, 6.7, 7.3, 6.2, 5.9, 7.1, 7.1},
                         {6.8, 7.1, 7.7, 8.3, 7.7, 8.6, 6.6},
                         {7.0, 9.2, 7.1, 7.2, 9.7, 10.9, 8.3},
                         {8.4, 9.8, 8.5, 8.4, 7.9, 9.0, 8.1},
                         {10.0, 8.0, 7.7, 10.1, 7.2, 7.4, 6.7},
                         {6.5, 6.6, 6.1, 8.4, 7.8, 5.0, 7.3},
                         {8.6, 8.5, 8.2, 7.2, 8.3, 8.5, 6.0},
                         {8.4, 8.2, 7.9, 8.0, 7.5, 8.7, 5.9}}};

double interpolated(const Table& table, double row, double column) {
  const int r = std::min(static_cast<int>(row), num_heights - 2);
  const int c = std::min(static_cast<int>(column), num_angles - 2);
  const double t = row - r, s = column - c;
  return (1 - t) * ((1 - s) * table[r][c] + s * table[r][c + 1]) +
         t * ((1 - s) * table[r + 1][c] + s * table[r + 1][c + 1]);
}

}  // namespace

UsualRadius usual_radius(double angle, double above_apices) {
  const double column = std::abs(angle) / angle_step;
  if (column > num_angles - 1) return {};
  const double row =
      std::clamp((above_apices - first_height_mm) / height_step_mm, 0.0, num_heights - 1.0);
  const double spread = interpolated(spreads, row, column);
  const double bone = std::max(0.0, 1 - std::abs(angle) / breastbone_angle) * breastbone_mm;
  return {interpolated(means, row, column), std::hypot(spread, grid_mm, bone)};
}

std::vector<UsualRadius> usual_radii(const PectoralWall& grid, const BreastFrame& frame) {
  const double height = (frame.left_apex.z() + frame.right_apex.z()) / 2;
  std::vector<UsualRadius> usual;
  for (int row = 0; row < grid.rows; ++row)
    for (int a = 0; a < grid.angles; ++a)
      usual.push_back(usual_radius(grid.first_angle + a * grid.angle_step,
                                   grid.first_z + row * grid.z_step - height));
  return usual;
}

void add_prior(const std::vector<UsualRadius>& usual, std::vector<float>& costs) {
  for (std::size_t n = 0; n < usual.size(); ++n)
    for (int d = 0; d < PolarRays::depths; ++d) {
      const double off = usual[n].deviation(PolarRays::least_radius_mm + d);
      costs[n * PolarRays::depths + d] +=
          static_cast<float>(std::min(usual[n].most, off * off / 2));
    }
}

}  // namespace mammotwin
