#include "pipeline/synthesize/view_extent.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mammotwin {
namespace {

using Eigen::Vector3d;

constexpr double edge_clearance_mm = 10;  // from the plates' edge back to the chest wall

template <class Visit>
void for_region(const Volume<std::uint8_t>& labels, const BreastRegion& region,
                const Visit& visit) {
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const Vector3d x = labels.position(i, j, k);
        if (region.contains(x)) visit(x, labels(i, j, k));
      }
}

}  // namespace

double extent_along_beam(const Volume<std::uint8_t>& labels, const BreastRegion& region,
                         double angle_deg) {
  double edge_y = 1e9;
  for_region(labels, region, [&](const Vector3d& x, std::uint8_t value) {
    if (value == label::muscle) edge_y = std::min(edge_y, x.y() - edge_clearance_mm);
  });
  const double angle = angle_deg * std::numbers::pi / 180;
  const double outward = region.side == Side::left ? 1 : -1;
  const Vector3d beam(outward * std::sin(angle), 0, -std::cos(angle));
  double low = 1e9, high = -1e9;
  for_region(labels, region, [&](const Vector3d& x, std::uint8_t value) {
    if (!label::is_breast(value) || x.y() > edge_y) return;
    low = std::min(low, x.dot(beam)), high = std::max(high, x.dot(beam));
  });
  return std::max(high - low, 0.0);
}

}  // namespace mammotwin
