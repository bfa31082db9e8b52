#include "segmentation/chest_wall/compared_wall.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "segmentation/image/order_statistics.h"
#include "segmentation/segment_limits.h"

namespace mammotwin {
namespace {

constexpr double farthest_mm = 30, step_mm = 1;
constexpr double least_breast_mm = 25;  // before the wall, else it is skin over muscle

/// Along a ray of `found`, the radius at which `other` begins: the nearest to where found does.
double radius_seen(const PectoralWall& found, std::size_t ray, const PectoralWall& other) {
  const auto behind = [&](double by) {
    return other.is_behind(found.position(ray, found.radius[ray] + by));
  };
  // The radius grows forward: in front of the wall it is larger.
  const double way = behind(0) ? step_mm : -step_mm;
  double by = 0;
  while (std::abs(by) < farthest_mm && behind(by) == (way > 0)) by += way;
  return found.radius[ray] + by - way / 2;
}

bool is_within(const Volume<std::uint8_t>& body, const Eigen::Vector3d& x_in_lps) {
  const Eigen::Vector3i v = body.index(x_in_lps).array().round().cast<int>();
  return body.contains(v.x(), v.y(), v.z()) && body(v.x(), v.y(), v.z());
}

}  // namespace

ComparedWall compared_wall(const Volume<float>& image, const PectoralWall& found,
                           const BodyStage& body, Side side, double stiffness) {
  SegmentQuality of_the_other;
  const BodyStage there = find_body(image, {}, of_the_other);
  const PectoralWall other = find_wall(there, {}, side, stiffness).found.wall;
  ComparedWall compared{{}, there.frame.z_low, there.frame.z_high};
  for (std::size_t n = 0; n < found.radius.size(); ++n)
    compared.radius.push_back(
        is_within(body.body, found.position(n, found.radius[n] + least_breast_mm))
            ? radius_seen(found, n, other)
            : std::numeric_limits<double>::quiet_NaN());
  return compared;
}

void judge_compared_wall(const PectoralWall& found, const ComparedWall& compared,
                         const BreastFrame& frame, const BreastRegion& region,
                         const std::string& called, SegmentQuality& quality) {
  const double low = std::max({frame.z_low, region.z_min, compared.z_low}),
               high = std::min({frame.z_high, region.z_max, compared.z_high});
  std::vector<double> off;
  std::vector<std::size_t> where;
  std::size_t all = 0;
  for (const std::size_t n : found.rays_before(region.side, low, high, breastbone_degrees)) {
    if (std::isnan(compared.radius[n]) || !region.contains(found.position(n, found.radius[n])))
      continue;
    ++all;
    const double by = compared.radius[n] - found.radius[n];
    if (std::abs(by) > other_edge_mm) off.push_back(by), where.push_back(n);
  }
  const double share = static_cast<double>(off.size()) / std::max<std::size_t>(all, 1);
  quality.chest_wall_unlike_compared = share;
  if (share <= limits::chest_wall_unlike_compared) return;
  const double by = median(off);
  const WallPatch patch = largest_patch(found, where);
  std::ostringstream reason;
  reason << "over " << std::lround(100 * share) << " % of its front the chest wall lies "
         << std::lround(std::abs(by)) << " mm " << (by > 0 ? "further forward" : "deeper") << " in "
         << called << " than found: one of the two is wrong, or the patient moved in between";
  quality.doubt(SegmentStatus::look,
                {"chest wall", reason.str(), patch.middle_in_lps, patch.radius_mm()});
}

}  // namespace mammotwin
