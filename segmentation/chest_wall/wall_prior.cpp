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
constexpr Table means{{{84.3, 86.4, 93.8, 105.8, 119.1, 135.2, 150.3},
                       {85.5, 87.4, 94.8, 106.0, 117.8, 131.5, 142.7},
                       {83.4, 88.8, 96.1, 105.2, 115.4, 127.1, 137.0},
                       {83.7, 88.6, 95.4, 105.0, 114.9, 123.5, 132.2},
                       {87.3, 91.5, 98.5, 106.5, 114.8, 120.5, 130.2},
                       {89.3, 93.9, 101.8, 108.8, 114.7, 117.3, 127.3},
                       {88.6, 92.5, 100.9, 109.5, 114.8, 115.2, 125.9},
                       {85.9, 89.1, 97.0, 106.5, 114.6, 115.3, 122.4},
                       {82.3, 84.8, 90.6, 99.1, 112.2, 118.2, 120.5},
                       {75.6, 78.3, 81.7, 91.1, 102.4, 116.5, 120.2},
                       {70.6, 73.5, 76.3, 81.3, 90.2, 106.4, 121.6},
                       {63.3, 66.8, 70.6, 77.5, 84.0, 97.4, 120.9}}};
constexpr Table spreads{{{7.3, 7.6, 8.3, 8.0, 7.1, 5.4, 9.8},
                         {5.9, 6.5, 8.2, 6.4, 6.0, 5.1, 6.1},
                         {5.0, 6.2, 7.5, 7.1, 5.5, 6.0, 6.2},
                         {5.8, 6.6, 7.9, 6.3, 5.4, 5.6, 7.5},
                         {7.4, 6.4, 7.8, 6.0, 5.8, 7.0, 6.8},
                         {6.6, 6.8, 8.0, 8.0, 7.0, 8.6, 9.0},
                         {7.4, 8.7, 7.0, 8.3, 9.9, 9.9, 7.4},
                         {8.3, 10.8, 8.1, 8.0, 7.9, 10.1, 8.1},
                         {10.0, 9.9, 10.7, 10.3, 7.0, 7.5, 7.8},
                         {6.8, 6.7, 8.8, 10.7, 7.1, 4.9, 7.2},
                         {6.6, 6.9, 7.1, 7.0, 8.4, 8.1, 7.4},
                         {9.1, 8.1, 9.1, 7.1, 7.6, 9.1, 6.4}}};

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
  constexpr double most = 3;
  for (std::size_t n = 0; n < usual.size(); ++n)
    for (int d = 0; d < PolarRays::depths; ++d) {
      const double off = usual[n].deviation(PolarRays::least_radius_mm + d);
      costs[n * PolarRays::depths + d] += static_cast<float>(std::min(most, off * off / 2));
    }
}

}  // namespace mammotwin
