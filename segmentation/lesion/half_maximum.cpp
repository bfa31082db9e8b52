#include "segmentation/lesion/half_maximum.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/image/components.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/masked.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/lesion/lesion_region.h"

namespace mammotwin {
namespace {

using Mask = Volume<std::uint8_t>;

constexpr double find_within_mm = 6;   // of the point: it may be that far off
constexpr double longest_neck_mm = 6;  // between a lesion and its lobe
constexpr double thin_share = 0.3;     // of the inscribed radius: tongues, which opening cuts off
constexpr int most_rounds = 12;
constexpr double soft_opening_share = 0.4;  // of the inscribed radius; chosen with soft_share

void join(Mask& mask, const Mask& other) {
  for (std::size_t v = 0; v < mask.values.size(); ++v) mask.values[v] |= other.values[v];
}

/// Voxel of the largest value in a mask; the first of equals.
std::size_t argmax(const Volume<float>& image, const Mask& mask) {
  std::size_t best = 0;
  float highest = -1e30F;
  for (std::size_t v = 0; v < mask.values.size(); ++v)
    if (mask.values[v] && image.values[v] > highest) highest = image.values[v], best = v;
  return best;
}

Mask component_at(const Mask& mask, std::size_t voxel) {
  const Components parts = connected_components(mask);
  const std::int32_t id = parts.ids.values[voxel];
  auto out = mask.like<std::uint8_t>(0);
  if (id > 0)
    for (std::size_t v = 0; v < out.values.size(); ++v) out.values[v] = parts.ids.values[v] == id;
  return out;
}

}  // namespace

Mask HalfMaximum::run(FoundLesion& lesion) {
  const Volume<float> wide = gaussian_smoothed(image_, 1.5);
  const Mask near = where(allowed_, [&](const Eigen::Vector3d& x, std::size_t v) {
    return allowed_.values[v] && (x - point_).norm() <= find_within_mm;
  });
  core_ = argmax(wide, near);
  lesion.brightness = wide.values[core_];
  lesion.background = median_in(image_, where(allowed_, [&](const auto& x, std::size_t v) {
                                  const double d = (x - point_).norm();
                                  return allowed_.values[v] && d > 10 && d < 25;
                                }));
  Mask region = allowed_.like<std::uint8_t>(0);
  for (int round = 0; round < most_rounds; ++round) {
    const Mask next = grow(lesion, false);
    if (count(next) == 0 || next.values == region.values) break;
    region = next;
    measure(region, lesion);
  }
  // Dark lobes would be gland.
  if (count(region) > 0 && search_.brighter) region = grow(lesion, true);
  return region;
}

Mask HalfMaximum::what_is_over(double threshold) const {
  return where(allowed_, [&](const Eigen::Vector3d& x, std::size_t v) {
    return allowed_.values[v] && image_.values[v] > threshold &&
           (x - point_).norm() <= search_.reach_mm;
  });
}

Mask HalfMaximum::at_share(const FoundLesion& lesion, double share) const {
  const double threshold = lesion.background + share * (lesion.brightness - lesion.background);
  const Mask above = what_is_over(threshold);
  const Volume<float> depth = inner_distance(above);
  const double opening_mm = std::min(soft_opening_share * lesion.inscribed_mm, most_opening_mm);
  const Volume<float> to_kept = distance_to(component_at(
      where(above, [&](const auto&, std::size_t v) { return depth.values[v] > opening_mm; }),
      core_));
  return where(above, [&](const auto&, std::size_t v) {
    return above.values[v] && to_kept.values[v] <= opening_mm;
  });
}

Mask HalfMaximum::grow(FoundLesion& lesion, bool with_lobes) {
  const double threshold = (lesion.brightness + lesion.background) / 2;
  const Mask above = component_at(what_is_over(threshold), core_);
  if (count(above) == 0) return above;
  // The inscribed ball nearest to the core: a large neighbour must not draw the lesion away.
  const Volume<float> depth = inner_distance(above);
  lesion.inscribed_mm = deepest_near_core(depth);
  const double opening_mm = opening_of(lesion);
  const Mask inner =
      where(above, [&](const auto&, std::size_t v) { return depth.values[v] > opening_mm; });
  Mask kept = component_at(inner, core_);
  if (count(kept) == 0) return kept;
  if (with_lobes) join(kept, lobes_of(inner, kept, 2 * opening_mm + longest_neck_mm, lesion));
  const Volume<float> to_kept = distance_to(kept);
  Mask region = where(above, [&](const auto&, std::size_t v) {
    return above.values[v] && to_kept.values[v] <= opening_mm;
  });
  const double thin_mm = thin_share * lesion.inscribed_mm;
  if (!with_lobes || thin_mm >= opening_mm) return region;
  const Mask thin = where(above, [&](const auto&, std::size_t v) {
    return depth.values[v] > thin_mm && to_kept.values[v] > opening_mm;
  });
  const double beside_mm = opening_mm + above.spacing.maxCoeff();
  const Mask tongues = lobes_of(thin, kept, beside_mm, lesion);
  if (count(tongues) == 0) return region;
  const Volume<float> to_tongues = distance_to(tongues);
  return where(above, [&](const auto&, std::size_t v) {
    return region.values[v] || (above.values[v] && to_tongues.values[v] <= thin_mm);
  });
}

Mask HalfMaximum::lobes_of(const Mask& mask, const Mask& kept, double most_gap_mm,
                           const FoundLesion& lesion) const {
  // True lobes of simulated lesions were within 0.07 of the lesion's contrast, tongues, which
  // blur dims, within 0.2; what touches a real lesion behind a neck (fat that was not suppressed,
  // vessels) 0.3 and more off.
  constexpr double largest = 0.5, unlike = 0.2;
  const Components parts = connected_components(mask);
  const Volume<float> to_kept = distance_to(kept);
  const double kept_size = count(kept);
  std::vector<double> gap(parts.sizes.size(), 1e9), sum(parts.sizes.size(), 0);
  for (std::size_t v = 0; v < mask.values.size(); ++v) {
    const std::int32_t part = parts.ids.values[v];
    gap[part] = std::min<double>(gap[part], to_kept.values[v]), sum[part] += image_.values[v];
  }
  const double contrast = lesion.brightness - lesion.background;
  std::vector<std::uint8_t> is_lobe(parts.sizes.size(), 0);
  for (std::size_t part = 1; part < parts.sizes.size(); ++part) {
    const double size = static_cast<double>(parts.sizes[part]);
    is_lobe[part] = size <= largest * kept_size && gap[part] <= most_gap_mm &&
                    std::abs(sum[part] / size - lesion.brightness) < unlike * contrast;
  }
  auto lobes = mask.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < mask.values.size(); ++v)
    lobes.values[v] = is_lobe[parts.ids.values[v]];
  return lobes;
}

double HalfMaximum::deepest_near_core(const Volume<float>& depth) {
  for (int step = 0; step < 50; ++step) {
    const Eigen::Vector3d centre = image_.position(core_);
    const double radius = std::max<double>(depth.values[core_], 1.5 * depth.spacing.maxCoeff());
    const std::size_t next =
        argmax(depth, where(allowed_, [&](const Eigen::Vector3d& x, std::size_t) {
                 return (x - centre).norm() <= radius;
               }));
    if (!(depth.values[next] > depth.values[core_])) break;
    core_ = next;
  }
  return depth.values[core_];
}

void HalfMaximum::measure(const Mask& mask, FoundLesion& lesion) const {
  const LesionRegion region(mask, allowed_);
  lesion.brightness = region.brightness(image_, opening_of(lesion));
  lesion.background = region.background(image_).value_or(lesion.background);
}

}  // namespace mammotwin
