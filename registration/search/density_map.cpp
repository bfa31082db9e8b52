#include "registration/search/density_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fitting/mesh/inverse_map.h"

namespace mammotwin {
namespace {

constexpr double kBroad_mm = 25;  // half width of the mean that is taken off
constexpr std::size_t kMostSamples = 25000;
constexpr double kDense = 0.15;  // least fraction of a sample

bool within(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& uv) {
  bool inside = false;  // crossings of the line to the left, the outline closed by the chest wall
  for (std::size_t n = 0, before = outline.size() - 1; n < outline.size(); before = n++) {
    const Eigen::Vector2d &a = outline[before], &b = outline[n];
    if ((a.y() > uv.y()) == (b.y() > uv.y())) continue;
    inside ^= uv.x() < a.x() + (uv.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
  }
  return inside;
}

double distance_to(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& uv) {
  double squared = 1e30;
  for (const Eigen::Vector2d& x : outline) squared = std::min(squared, (x - uv).squaredNorm());
  return std::sqrt(squared);
}

/// Mean over the counted cells in a square round each cell.
std::vector<double> broad_mean(const DensityGrid& grid, const std::vector<double>& values,
                               const std::vector<double>& shares) {
  const int reach = static_cast<int>(kBroad_mm / grid.cell_mm);
  std::vector<double> mean(values.size(), 0);
  for (const int cell : grid.cells) {
    const int i = cell % grid.columns, j = cell / grid.columns;
    double sum = 0, count = 0;
    for (int b = std::max(0, j - reach); b <= std::min(grid.rows - 1, j + reach); ++b)
      for (int a = std::max(0, i - reach); a <= std::min(grid.columns - 1, i + reach); ++a) {
        const int beside = b * grid.columns + a;
        if (!grid.inside[beside]) continue;
        sum += shares[beside] * values[beside];
        count += shares[beside];
      }
    if (count > 0) mean[cell] = sum / count;
  }
  return mean;
}

/// Of the counted cells, what is left without its mean over 25 mm, mean 0.
Eigen::VectorXd detail_of(const DensityGrid& grid, const std::vector<double>& values,
                          const std::vector<double>& shares) {
  Eigen::VectorXd detail =
      in_counted(grid, values) - in_counted(grid, broad_mean(grid, values, shares));
  const Eigen::VectorXd weight = in_counted(grid, shares);
  if (weight.sum() > 0) detail.array() -= weight.dot(detail) / weight.sum();
  return detail;
}

double root_mean_square(const Eigen::VectorXd& values, const Eigen::VectorXd& weight) {
  return weight.sum() > 0 ? std::sqrt(weight.dot(values.cwiseAbs2()) / weight.sum()) : 0;
}

}  // namespace

DensityGrid density_grid(const std::vector<Eigen::Vector2d>& outline) {
  DensityGrid grid;
  Eigen::Vector2d low(0, outline.front().y()), high(0, low.y());
  for (const Eigen::Vector2d& x : outline) {
    low.y() = std::min(low.y(), x.y());
    high = high.cwiseMax(x);
  }
  grid.first = low + Eigen::Vector2d::Constant(grid.cell_mm / 2);
  grid.columns = std::max(1, static_cast<int>((high.x() - low.x()) / grid.cell_mm));
  grid.rows = std::max(1, static_cast<int>((high.y() - low.y()) / grid.cell_mm));
  grid.inside.assign(grid.columns * grid.rows, 0);
  for (int cell = 0; cell < grid.columns * grid.rows; ++cell) {
    const Eigen::Vector2d uv = grid.middle(cell);
    if (uv.x() < kPatternInside_mm || !within(outline, uv) ||
        distance_to(outline, uv) < kPatternInside_mm)
      continue;
    grid.inside[cell] = 1;
    grid.cells.push_back(cell);
  }
  return grid;
}

Eigen::VectorXd in_counted(const DensityGrid& grid, const std::vector<double>& by_cell) {
  Eigen::VectorXd counted(grid.cells.size());
  for (std::size_t n = 0; n < grid.cells.size(); ++n) counted[n] = by_cell[grid.cells[n]];
  return counted;
}

std::vector<double> shares_before(const PlatesEdge& edge, const DensityGrid& grid) {
  std::vector<double> shares(grid.inside.size(), 0);
  for (const int cell : grid.cells) {
    const double t = std::clamp(edge.before_mm(grid.middle(cell)) / kPatternInside_mm, 0., 1.);
    shares[cell] = t * t * (3 - 2 * t);
  }
  return shares;
}

Eigen::VectorXd pattern(const DensityGrid& grid, const std::vector<double>& values,
                        const std::vector<double>& shares) {
  const Eigen::VectorXd detail = detail_of(grid, values, shares);
  const double sd = root_mean_square(detail, in_counted(grid, shares));
  return sd > 0 ? Eigen::VectorXd(detail / sd) : Eigen::VectorXd::Zero(detail.size());
}

std::vector<double> grey_in_cells(const DensityGrid& grid, const MammogramImage& image,
                                  const Detector& detector) {
  std::vector<double> mean(grid.columns * grid.rows, 0);
  const int reach = std::max(1, static_cast<int>(grid.cell_mm / 2 / detector.pixels->spacing_mm));
  for (const int cell : grid.cells) {
    const Eigen::Vector2d at = detector.image_from_detector(grid.middle(cell));
    const int column = static_cast<int>(at.x()), row = static_cast<int>(at.y());
    double sum = 0;
    int count = 0;
    for (int r = std::max(0, row - reach); r <= std::min(image.rows - 1, row + reach); ++r)
      for (int c = std::max(0, column - reach); c <= std::min(image.columns - 1, column + reach);
           ++c) {
        sum += image.at(c, r);
        ++count;
      }
    if (count > 0) mean[cell] = sum / count;
  }
  return mean;
}

DenseTissue::DenseTissue(const ReducedView& view, const HermiteMesh& prone,
                         const Volume<Fractions>& fractions)
    : DenseTissue(view, sampled(prone, fractions)) {}

DenseTissue::DenseTissue(const ReducedView& view, Points points)
    : volumes_(std::move(points.volumes)), samples_(view, points.points) {}

DenseTissue::Points DenseTissue::sampled(const HermiteMesh& prone,
                                         const Volume<Fractions>& fractions) {
  std::vector<std::size_t> dense;
  for (std::size_t v = 0; v < fractions.values.size(); ++v)
    if (fractions.values[v].fibroglandular + fractions.values[v].lesion > kDense)
      dense.push_back(v);
  const std::size_t step = dense.size() / kMostSamples + 1;
  const InverseMap inverse(prone);
  std::optional<MeshPoint> last;
  Points points;
  for (std::size_t n = 0; n < dense.size(); n += step) {
    const std::size_t v = dense[n];
    const int nx = fractions.size.x(), ny = fractions.size.y();
    const Eigen::Vector3d x = fractions.position(v % nx, v / nx % ny, v / nx / ny);
    const auto found = last ? inverse.locate(x, *last) : inverse.locate(x);
    if (!found) continue;
    last = found;
    points.points.push_back(*found);
    points.volumes.push_back((fractions.values[v].fibroglandular + fractions.values[v].lesion) *
                             fractions.voxel_volume() * step);
  }
  return points;
}

std::vector<double> DenseTissue::in_cells(const DensityGrid& grid, const ReducedView& view,
                                          const ViewState& z, const Detector& detector) const {
  const ViewSamples::Points x = samples_.at(view, z);
  std::vector<double> sum(grid.columns * grid.rows, 0);
  for (Eigen::Index n = 0; n < x.cols(); ++n) {
    const Eigen::Vector2d at = (detector.project(x.col(n)) - grid.first) / grid.cell_mm;
    const int i = static_cast<int>(std::floor(at.x())), j = static_cast<int>(std::floor(at.y()));
    const double a = at.x() - i, b = at.y() - j;
    const auto add = [&](int column, int row, double weight) {
      if (column >= 0 && row >= 0 && column < grid.columns && row < grid.rows)
        sum[row * grid.columns + column] += weight * volumes_[n];
    };
    add(i, j, (1 - a) * (1 - b));
    add(i + 1, j, a * (1 - b));
    add(i, j + 1, (1 - a) * b);
    add(i + 1, j + 1, a * b);
  }
  return sum;
}

double DenseTissue::detail_mm(const DensityGrid& grid, const ReducedView& view, const ViewState& z,
                              const Detector& detector) const {
  const double cell_mm2 = grid.cell_mm * grid.cell_mm;
  const std::vector<double> shares = shares_before(view.plates_edge(z), grid);
  return root_mean_square(detail_of(grid, in_cells(grid, view, z, detector), shares),
                          in_counted(grid, shares)) /
         cell_mm2;
}

}  // namespace mammotwin
