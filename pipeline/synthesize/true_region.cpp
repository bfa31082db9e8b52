#include "pipeline/synthesize/true_region.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mammotwin {
namespace {

constexpr double beyond_mm = 15, apex_share = 0.35;
constexpr double least_mm = 5, least_lateral_mm = 8;

struct Apex {
  int i = -1, k = -1;
  double front = 1e9;
};

bool on_side(double x, Side side) { return side == Side::left ? x > 0 : x < 0; }

Apex find_apex(const ColumnMap& c, Side side) {
  Apex apex;
  for (int k = 0; k < c.nz; ++k)
    for (int i = 0; i < c.nx; ++i)
      if (on_side(c.x(i), side) && c.at(c.front, i, k) < apex.front)
        apex = {i, k, c.at(c.front, i, k)};
  if (apex.i < 0)
    throw std::runtime_error(side == Side::left ? "no breast tissue on the left"
                                                : "no breast tissue on the right");
  return apex;
}

/// Columns that `belongs` holds for and that hang together with the apex by their sides.
template <class Belongs>
std::vector<std::pair<int, int>> connected_to(const Apex& apex, const ColumnMap& c,
                                              const Belongs& belongs) {
  std::vector<char> seen(c.thickness.size(), 0);
  std::vector<std::pair<int, int>> found;
  const auto visit = [&](int i, int k) {
    if (i < 0 || k < 0 || i >= c.nx || k >= c.nz || seen[k * c.nx + i] || !belongs(i, k)) return;
    seen[k * c.nx + i] = 1;
    found.emplace_back(i, k);
  };
  visit(apex.i, apex.k);
  for (std::size_t n = 0; n < found.size(); ++n) {
    const auto [i, k] = found[n];
    visit(i - 1, k), visit(i + 1, k), visit(i, k - 1), visit(i, k + 1);
  }
  return found;
}

/// Foremost tissue of every column of x over the rows near an apex.
double front_near(const ColumnMap& c, int i, int k) {
  const int reach = std::max(1, static_cast<int>(10 / c.step_z));
  double front = 1e9;
  for (int r = std::max(0, k - reach); r <= std::min(c.nz - 1, k + reach); ++r)
    front = std::min<double>(front, c.at(c.front, i, r));
  return front;
}

/// Middle of the plateau furthest back between the apices.
double valley(const ColumnMap& c, const Apex& left, const Apex& right) {
  const int from = std::min(left.i, right.i), to = std::max(left.i, right.i);
  double back = -1e9;
  for (int i = from; i <= to; ++i) {
    const double f = front_near(c, i, (left.k + right.k) / 2);
    if (f < 1e8) back = std::max(back, f);
  }
  double sum = 0;
  int count = 0;
  for (int i = from; i <= to; ++i)
    if (front_near(c, i, (left.k + right.k) / 2) > back - 2) sum += c.x(i), ++count;
  return count > 0 ? sum / count : 0;
}

double least_in_column(const ColumnMap& c, const BreastRegion& r, int i) {
  double least = 1e9;
  for (int k = 0; k < c.nz; ++k)
    if (c.z(k) >= r.z_min && c.z(k) <= r.z_max)
      least = std::min<double>(least, c.at(c.thickness, i, k));
  return least;
}

double least_in_row(const ColumnMap& c, const BreastRegion& r, int k) {
  double least = 1e9;
  for (int i = 0; i < c.nx; ++i)
    if (c.x(i) >= r.x_min && c.x(i) <= r.x_max)
      least = std::min<double>(least, c.at(c.thickness, i, k));
  return least;
}

void pull_in(const ColumnMap& c, Side side, BreastRegion& r) {
  const auto column = [&](double x) {
    return std::clamp(static_cast<int>(std::lround((x - c.x0) / c.step_x)), 0, c.nx - 1);
  };
  const auto row = [&](double z) {
    return std::clamp(static_cast<int>(std::lround((z - c.z0) / c.step_z)), 0, c.nz - 1);
  };
  double& lateral = side == Side::left ? r.x_max : r.x_min;
  const double inward = side == Side::left ? -c.step_x : c.step_x;
  while (r.x_max - r.x_min > 20 && least_in_column(c, r, column(lateral)) < least_lateral_mm)
    lateral += inward;
  while (r.z_max - r.z_min > 20 && least_in_row(c, r, row(r.z_max)) < least_mm) r.z_max -= c.step_z;
  while (r.z_max - r.z_min > 20 && least_in_row(c, r, row(r.z_min)) < least_mm) r.z_min += c.step_z;
}

}  // namespace

ColumnMap columns_of(const Volume<std::uint8_t>& labels) {
  ColumnMap c;
  c.nx = labels.size.x(), c.nz = labels.size.z();
  c.x0 = labels.origin.x(), c.z0 = labels.origin.z();
  c.step_x = labels.spacing.x(), c.step_z = labels.spacing.z();
  c.thickness.assign(static_cast<std::size_t>(c.nx) * c.nz, 0);
  c.front.assign(c.thickness.size(), 1e9f);
  for (int k = 0; k < c.nz; ++k)
    for (int j = labels.size.y() - 1; j >= 0; --j)
      for (int i = 0; i < c.nx; ++i) {
        if (!label::is_breast(labels(i, j, k))) continue;
        c.at(c.thickness, i, k) += static_cast<float>(labels.spacing.y());
        c.at(c.front, i, k) = static_cast<float>(labels.origin.y() + j * labels.spacing.y());
      }
  return c;
}

BreastRegion true_region(const ColumnMap& c, Side side,
                         const std::vector<Eigen::Vector3d>& points_inside) {
  const Apex left = find_apex(c, Side::left), right = find_apex(c, Side::right);
  const Apex& apex = side == Side::left ? left : right;
  const double thick = apex_share * c.at(c.thickness, apex.i, apex.k);
  const double medial = valley(c, left, right);

  BreastRegion r{side, 1e9, -1e9, 1e9, -1e9};
  for (const auto& [i, k] : connected_to(apex, c, [&](int i, int k) {
         return on_side(c.x(i) - medial, side) && c.at(c.thickness, i, k) >= thick;
       })) {
    r.x_min = std::min(r.x_min, c.x(i) - beyond_mm),
    r.x_max = std::max(r.x_max, c.x(i) + beyond_mm);
    r.z_min = std::min(r.z_min, c.z(k) - beyond_mm),
    r.z_max = std::max(r.z_max, c.z(k) + beyond_mm);
  }
  (side == Side::left ? r.x_min : r.x_max) = medial;
  r.x_min = std::max(r.x_min, c.x0), r.x_max = std::min(r.x_max, c.x(c.nx - 1));
  r.z_min = std::max(r.z_min, c.z0), r.z_max = std::min(r.z_max, c.z(c.nz - 1));
  pull_in(c, side, r);
  for (const auto& p : points_inside) {
    r.x_min = std::min(r.x_min, p.x()), r.x_max = std::max(r.x_max, p.x());
    r.z_min = std::min(r.z_min, p.z()), r.z_max = std::max(r.z_max, p.z());
  }
  return r;
}

double volume_ml(const ColumnMap& c, const BreastRegion& r) {
  double sum = 0;
  for (int k = 0; k < c.nz; ++k)
    for (int i = 0; i < c.nx; ++i)
      if (r.contains({c.x(i), 0, c.z(k)})) sum += c.at(c.thickness, i, k);
  return sum * c.step_x * c.step_z / 1000;
}

}  // namespace mammotwin
