#include "pipeline/report/drawing/lesion_outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mammotwin {
namespace {

constexpr double kOutlineStep_mm =
    0.5;  // between corners of the squares that the edge is sought in

std::vector<Eigen::Vector2d> projected_voxels(const Volume<std::uint8_t>& labels,
                                              std::uint8_t value,
                                              const ViewProjection& projection) {
  std::vector<Eigen::Vector2d> places;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i)
        if (labels(i, j, k) == value)
          places.push_back(projection.project({"", labels.position(i, j, k)}).on_detector);
  return places;
}

/// Distance to the rim of the nearest disc [mm] on a grid, negative inside.
struct DiscField {
  Eigen::Vector2d first;
  int columns, rows;
  std::vector<double> distance;

  DiscField(const Eigen::AlignedBox2d& box)
      : first(box.min()),
        columns(static_cast<int>(box.sizes().x() / kOutlineStep_mm) + 1),
        rows(static_cast<int>(box.sizes().y() / kOutlineStep_mm) + 1),
        distance(static_cast<std::size_t>(columns) * rows, 2 * kOutlineStep_mm) {}

  Eigen::Vector2d corner(int i, int j) const {
    return first + kOutlineStep_mm * Eigen::Vector2d(i, j);
  }
  double& at(int i, int j) { return distance[static_cast<std::size_t>(j) * columns + i]; }

  void add(const Eigen::Vector2d& c, double radius) {
    const int reach = static_cast<int>(radius / kOutlineStep_mm) + 2;
    const Eigen::Vector2i middle =
        ((c - first) / kOutlineStep_mm).array().round().matrix().cast<int>();
    for (int j = std::max(0, middle.y() - reach); j <= std::min(rows - 1, middle.y() + reach); ++j)
      for (int i = std::max(0, middle.x() - reach); i <= std::min(columns - 1, middle.x() + reach);
           ++i)
        at(i, j) = std::min(at(i, j), (corner(i, j) - c).norm() - radius);
  }

  /// The discs without a border of that width.
  DiscField without_border(double width) {
    DiscField border(*this);
    std::fill(border.distance.begin(), border.distance.end(), 2 * kOutlineStep_mm);
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        if (at(i, j) >= 0) border.add(corner(i, j), width);
    for (std::size_t n = 0; n < distance.size(); ++n)
      border.distance[n] = std::max(distance[n], -border.distance[n]);
    return border;
  }
};

/// Where the field changes its sign in one triangle of corners.
void cut_triangle(const std::array<Eigen::Vector2d, 3>& x, const std::array<double, 3>& d,
                  DetectorPieces& pieces) {
  std::vector<Eigen::Vector2d> ends;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    if ((d[a] < 0) != (d[b] < 0)) ends.push_back(x[a] + d[a] / (d[a] - d[b]) * (x[b] - x[a]));
  }
  if (ends.size() == 2) pieces.emplace_back(ends[0], ends[1]);
}

}  // namespace

DetectorPieces lesion_outline(const Volume<std::uint8_t>& labels, std::uint8_t value,
                              const ViewProjection& projection) {
  const std::vector<Eigen::Vector2d> centres = projected_voxels(labels, value, projection);
  if (centres.empty()) return {};
  const double radius = std::cbrt(labels.voxel_volume() * 3 / (4 * std::numbers::pi));
  const double closing = labels.spacing.maxCoeff();  // over gaps between neighbours' shadows
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& c : centres) box.extend(c);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(radius + closing + 2 * kOutlineStep_mm);
  DiscField wide({box.min() - margin, box.max() + margin});
  for (const Eigen::Vector2d& c : centres) wide.add(c, radius + closing);
  DiscField field = wide.without_border(closing);
  DetectorPieces pieces;
  for (int j = 0; j + 1 < field.rows; ++j)
    for (int i = 0; i + 1 < field.columns; ++i)
      for (const bool upper : {false, true}) {
        const int a = upper ? i + 1 : i, b = upper ? j + 1 : j;  // the right angle's corner
        cut_triangle({field.corner(a, b), field.corner(i + 1, j), field.corner(i, j + 1)},
                     {field.at(a, b), field.at(i + 1, j), field.at(i, j + 1)}, pieces);
      }
  return pieces;
}

}  // namespace mammotwin
