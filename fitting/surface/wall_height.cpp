#include "fitting/surface/wall_height.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "segmentation/body/tissue_columns.h"
#include "segmentation/image/components.h"
#include "segmentation/image/order_statistics.h"

namespace mammotwin {

namespace {

constexpr int median_radius = 4;          // columns
constexpr double gaussian_sigma = 2.0;    // [mm]
constexpr double pit_slope = 1.5;         // steeper pits fold the slab
constexpr double lesion_clearance = 1.0;  // [mm], what the fit's wall strays by
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Columns [first, last] whose centres lie in the region.
struct ColumnRange {
  int i0, i1, k0, k1;
  bool contains(int i, int k) const { return i >= i0 && i <= i1 && k >= k0 && k <= k1; }
};

ColumnRange columns_of(const Volume<std::uint8_t>& grid, const BreastRegion& r) {
  const auto first = [](double limit, double origin, double spacing) {
    return std::max(0, static_cast<int>(std::ceil((limit - origin) / spacing - 1e-6)));
  };
  const auto last = [](double limit, double origin, double spacing, int size) {
    return std::min(size - 1, static_cast<int>(std::floor((limit - origin) / spacing + 1e-6)));
  };
  return {first(r.x_min, grid.origin.x(), grid.spacing.x()),
          last(r.x_max, grid.origin.x(), grid.spacing.x(), grid.size.x()),
          first(r.z_min, grid.origin.z(), grid.spacing.z()),
          last(r.z_max, grid.origin.z(), grid.spacing.z(), grid.size.z())};
}

/// Muscle but for vessels and specks.
Volume<std::uint8_t> large_muscle(const Volume<std::uint8_t>& labels) {
  auto muscle = labels.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < labels.values.size(); ++v)
    muscle.values[v] = labels.values[v] == label::muscle;
  return without_small_components(muscle, least_muscle_ml);
}

/// Raw heights of one region: muscle front, else end of tissue, with a note of which it is.
struct RawHeights {
  std::vector<double> muscle, tissue_end;
};

RawHeights raw_heights(const Volume<std::uint8_t>& labels, const ColumnRange& range) {
  const Volume<std::uint8_t> muscle = large_muscle(labels);
  const std::size_t columns = static_cast<std::size_t>(labels.size.x()) * labels.size.z();
  RawHeights raw{std::vector<double>(columns, unknown), std::vector<double>(columns, unknown)};
  for (int k = range.k0; k <= range.k1; ++k)
    for (int i = range.i0; i <= range.i1; ++i) {
      const std::size_t column = i + static_cast<std::size_t>(labels.size.x()) * k;
      for (int j = 0; j < labels.size.y(); ++j) {
        const double y = labels.position(i, j, k).y();
        if (muscle(i, j, k)) {
          raw.muscle[column] = y - labels.spacing.y() / 2;
          break;
        }
        if (label::is_breast(labels(i, j, k))) raw.tissue_end[column] = y + labels.spacing.y() / 2;
      }
    }
  return raw;
}

/// Gaps that reach the border take the end of the tissue where there is one.
void fill_open_gaps(const RawHeights& raw, const ColumnRange& range, int nx,
                    std::vector<double>& heights) {
  std::vector<std::array<int, 2>> front;
  std::vector<bool> seen(heights.size(), false);
  const auto visit = [&](int i, int k) {
    const std::size_t c = i + static_cast<std::size_t>(nx) * k;
    if (!range.contains(i, k) || seen[c] || !std::isnan(raw.muscle[c])) return;
    seen[c] = true;
    heights[c] = raw.tissue_end[c];
    front.push_back({i, k});
  };
  for (int i = range.i0; i <= range.i1; ++i) visit(i, range.k0), visit(i, range.k1);
  for (int k = range.k0; k <= range.k1; ++k) visit(range.i0, k), visit(range.i1, k);
  for (std::size_t at = 0; at < front.size(); ++at) {
    const auto [i, k] = front[at];
    visit(i - 1, k), visit(i + 1, k), visit(i, k - 1), visit(i, k + 1);
  }
}

/// Fills what is unknown with the harmonic surface over the gaps' rims; at the region's border,
/// where no rim is, it ends level. Leaves everything unknown where nothing is known.
void interpolate_unknown(const ColumnRange& range, int nx, std::vector<double>& heights) {
  std::vector<std::array<int, 2>> gap;
  std::vector<int> number(heights.size(), -1);
  for (int k = range.k0; k <= range.k1; ++k)
    for (int i = range.i0; i <= range.i1; ++i) {
      const std::size_t column = i + static_cast<std::size_t>(nx) * k;
      if (!std::isnan(heights[column])) continue;
      number[column] = static_cast<int>(gap.size());
      gap.push_back({i, k});
    }
  const auto columns =
      static_cast<std::size_t>(range.i1 - range.i0 + 1) * (range.k1 - range.k0 + 1);
  if (gap.empty() || gap.size() == columns) return;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(gap.size()));
  std::vector<Eigen::Triplet<double>> laplacian;
  for (int row = 0; row < right.size(); ++row)
    for (const auto& [di, dk] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      const int i = gap[row][0] + di, k = gap[row][1] + dk;
      if (!range.contains(i, k)) continue;
      const std::size_t column = i + static_cast<std::size_t>(nx) * k;
      laplacian.emplace_back(row, row, 1);
      if (number[column] < 0)
        right[row] += heights[column];
      else
        laplacian.emplace_back(row, number[column], -1);
    }
  Eigen::SparseMatrix<double> matrix(right.size(), right.size());
  matrix.setFromTriplets(laplacian.begin(), laplacian.end());
  const Eigen::VectorXd filled =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
  for (int row = 0; row < right.size(); ++row)
    heights[gap[row][0] + static_cast<std::size_t>(nx) * gap[row][1]] = filled[row];
}

std::vector<double> median_filtered(const ColumnRange& range, int nx,
                                    const std::vector<double>& heights) {
  std::vector<double> result = heights, window;
  for (int k = range.k0; k <= range.k1; ++k)
    for (int i = range.i0; i <= range.i1; ++i) {
      // A window that shrinks symmetrically keeps slopes at the border.
      const int ri = std::min({median_radius, i - range.i0, range.i1 - i});
      const int rk = std::min({median_radius, k - range.k0, range.k1 - k});
      window.clear();
      for (int dk = -rk; dk <= rk; ++dk)
        for (int di = -ri; di <= ri; ++di)
          window.push_back(heights[i + di + static_cast<std::size_t>(nx) * (k + dk)]);
      result[i + static_cast<std::size_t>(nx) * k] = median(window);
    }
  return result;
}

/// Along one axis; beyond the border the field goes on as its point reflection, which keeps slopes.
void gaussian_filter(const ColumnRange& range, int nx, bool along_x, double spacing,
                     std::vector<double>& heights) {
  const double sigma = gaussian_sigma / spacing;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const int first = along_x ? range.i0 : range.k0, last = along_x ? range.i1 : range.k1;
  const int other_first = along_x ? range.k0 : range.i0, other_last = along_x ? range.k1 : range.i1;
  const auto offset = [&](int a, int b) {
    return along_x ? a + static_cast<std::size_t>(nx) * b : b + static_cast<std::size_t>(nx) * a;
  };
  std::vector<double> line(last - first + 1);
  for (int b = other_first; b <= other_last; ++b) {
    for (int a = first; a <= last; ++a) line[a - first] = heights[offset(a, b)];
    const int end = last - first;
    const auto value = [&](int a) {
      if (a < 0) return 2 * line[0] - line[std::min(-a, end)];
      if (a > end) return 2 * line[end] - line[std::max(2 * end - a, 0)];
      return line[a];
    };
    for (int a = 0; a <= end; ++a) {
      double sum = 0, weights = 0;
      for (int d = -radius; d <= radius; ++d) {
        const double w = std::exp(-0.5 * d * d / (sigma * sigma));
        sum += w * value(a + d);
        weights += w;
      }
      heights[offset(a + first, b)] = sum / weights;
    }
  }
}

/// A lesion's last voxel in a column, in position.
struct LesionEnd {
  int i, k;
  double y;
};

std::vector<LesionEnd> lesion_ends(const Volume<std::uint8_t>& labels, const ColumnRange& range) {
  std::vector<LesionEnd> ends;
  for (int k = range.k0; k <= range.k1; ++k)
    for (int i = range.i0; i <= range.i1; ++i)
      for (int j = labels.size.y() - 1; j >= 0; --j)
        if (label::is_lesion(labels(i, j, k))) {
          ends.push_back({i, k, labels.position(i, j, k).y() + labels.spacing.y() / 2});
          break;
        }
  return ends;
}

void hold_lesions(const Volume<std::uint8_t>& labels, const ColumnRange& range,
                  std::vector<double>& heights) {
  const std::vector<double> before = heights;
  for (const LesionEnd& end : lesion_ends(labels, range)) {
    const double y = end.y + lesion_clearance;
    const double excess = y - before[end.i + static_cast<std::size_t>(labels.size.x()) * end.k];
    if (excess <= 0) continue;
    const int ri = static_cast<int>(excess / pit_slope / labels.spacing.x()) + 1;
    const int rk = static_cast<int>(excess / pit_slope / labels.spacing.z()) + 1;
    for (int k = std::max(range.k0, end.k - rk); k <= std::min(range.k1, end.k + rk); ++k)
      for (int i = std::max(range.i0, end.i - ri); i <= std::min(range.i1, end.i + ri); ++i) {
        const double distance =
            std::hypot((i - end.i) * labels.spacing.x(), (k - end.k) * labels.spacing.z());
        double& h = heights[i + static_cast<std::size_t>(labels.size.x()) * k];
        h = std::max(h, y - pit_slope * distance);
      }
  }
}

/// Columns outside the region repeat the nearest one inside.
void extend(const ColumnRange& range, int nx, int nz, std::vector<double>& heights) {
  for (int k = 0; k < nz; ++k)
    for (int i = 0; i < nx; ++i)
      heights[i + static_cast<std::size_t>(nx) * k] =
          heights[std::clamp(i, range.i0, range.i1) +
                  static_cast<std::size_t>(nx) * std::clamp(k, range.k0, range.k1)];
}

}  // namespace

HeightField::HeightField(const Volume<std::uint8_t>& grid, std::vector<double> heights)
    : size_x_(grid.size.x()),
      size_z_(grid.size.z()),
      origin_x_(grid.origin.x()),
      origin_z_(grid.origin.z()),
      spacing_x_(grid.spacing.x()),
      spacing_z_(grid.spacing.z()),
      heights_(std::move(heights)) {}

double HeightField::operator()(double x, double z) const {
  const double u = std::clamp((x - origin_x_) / spacing_x_, 0.0, size_x_ - 1.0);
  const double v = std::clamp((z - origin_z_) / spacing_z_, 0.0, size_z_ - 1.0);
  const int i = std::min(static_cast<int>(u), size_x_ - 2);
  const int k = std::min(static_cast<int>(v), size_z_ - 2);
  const double a = u - i, b = v - k;
  return (1 - b) * ((1 - a) * at(i, k) + a * at(i + 1, k)) +
         b * ((1 - a) * at(i, k + 1) + a * at(i + 1, k + 1));
}

Eigen::Vector2d HeightField::slope(double x, double z) const {
  const HeightField& y = *this;
  return {(y(x + spacing_x_ / 2, z) - y(x - spacing_x_ / 2, z)) / spacing_x_,
          (y(x, z + spacing_z_ / 2) - y(x, z - spacing_z_ / 2)) / spacing_z_};
}

MuscleFront find_muscle_front(const Volume<std::uint8_t>& labels, const BreastRegion& region) {
  const ColumnRange range = columns_of(labels, region);
  const int nx = labels.size.x();
  const RawHeights raw = raw_heights(labels, range);
  MuscleFront wall;
  for (int k = range.k0; k <= range.k1; ++k)
    for (int i = range.i0; i <= range.i1; ++i) {
      const double y = raw.muscle[i + static_cast<std::size_t>(nx) * k];
      if (!std::isnan(y))
        wall.labelled.push_back({labels.position(i, 0, k).x(), y, labels.position(i, 0, k).z()});
    }
  std::vector<double> heights = raw.muscle;
  fill_open_gaps(raw, range, nx, heights);
  interpolate_unknown(range, nx, heights);
  heights = median_filtered(range, nx, heights);
  gaussian_filter(range, nx, true, labels.spacing.x(), heights);
  gaussian_filter(range, nx, false, labels.spacing.z(), heights);
  hold_lesions(labels, range, heights);
  extend(range, nx, labels.size.z(), heights);
  wall.height = HeightField(labels, std::move(heights));
  return wall;
}

}  // namespace mammotwin
