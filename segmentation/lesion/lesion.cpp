#include "segmentation/lesion/lesion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "segmentation/image/components.h"
#include "segmentation/image/crop.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/masked.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/lesion/random_walker.h"

namespace mammotwin {
namespace {

using Mask = Volume<std::uint8_t>;

constexpr double find_within_mm = 6;  // of the point: it may be that far off
constexpr double smoothing_mm = 0.4;
constexpr double opening_share = 0.5;  // of the inscribed radius
constexpr double most_opening_mm = 3;  // vessels are thinner, the lobes of a large lesion are not
constexpr double longest_neck_mm = 6;  // between a lesion and its lobe
constexpr double thin_share = 0.3;     // of the inscribed radius: tongues, which opening cuts off
constexpr double shell_from_mm = 2, shell_to_mm = 6;
constexpr double usual_reach_mm = 30, most_cut_mm2 = 100;
constexpr int most_rounds = 12;
// Of the contrast, and of the inscribed radius. Chosen on six contours of radiologists: two lesions
// are found over 3 mm and 20 % smaller than drawn, and both are said to be soft.
constexpr double soft_share = 0.3, soft_opening_share = 0.4;
constexpr double least_ml = 0.03;
constexpr double fallback_mm = 5;
constexpr double least_compact = 0.3;    // dark parts below are gland, not a lesion
constexpr double least_contrast = 0.15;  // over the surroundings, else nothing stands out

std::size_t count(const Mask& mask) {
  return static_cast<std::size_t>(std::count(mask.values.begin(), mask.values.end(), 1));
}

template <class Keep>
Mask where(const Mask& grid, const Keep& keep) {
  auto out = grid.like<std::uint8_t>(0);
  std::size_t v = 0;
  for (int k = 0; k < grid.size.z(); ++k)
    for (int j = 0; j < grid.size.y(); ++j)
      for (int i = 0; i < grid.size.x(); ++i, ++v) out.values[v] = keep(grid.position(i, j, k), v);
  return out;
}

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

Volume<float> inner_distance(const Mask& mask) {
  auto outside = mask;
  for (std::uint8_t& value : outside.values) value = !value;
  return distance_to(outside);
}

double opening_of(const FoundLesion& lesion) {
  return std::min(opening_share * lesion.inscribed_mm, most_opening_mm);
}

/// A lesion's voxels and what lies around them.
struct Region {
  const Mask &mask, &allowed;
  Volume<float> depth, away;  ///< of voxels inside and outside [mm]

  Region(const Mask& lesion, const Mask& may)
      : mask(lesion), allowed(may), depth(inner_distance(lesion)), away(distance_to(lesion)) {}

  double brightness(const Volume<float>& image, double opening_mm) const {
    return median_in(image, where(mask, [&](const auto&, std::size_t v) {
                       return depth.values[v] > opening_mm;
                     }));
  }
  /// Of the shell around it; empty if none of it is allowed.
  std::optional<double> background(const Volume<float>& image) const {
    const Mask shell = where(mask, [&](const auto&, std::size_t v) {
      return allowed.values[v] && away.values[v] > shell_from_mm && away.values[v] < shell_to_mm;
    });
    if (count(shell) == 0) return std::nullopt;
    return median_in(image, shell);
  }
};

/// Half maximum, iterated, in one crop of the image.
class HalfMaximum {
 public:
  HalfMaximum(const Volume<float>& image, const Mask& allowed, const Eigen::Vector3d& point,
              const LesionSearch& search)
      : image_(image), allowed_(allowed), point_(point), search_(search) {}

  Mask run(FoundLesion& lesion) {
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

  /// What is over a share of the contrast, opened a little less than the lesion found is: the part
  /// that holds the core.
  Mask at_share(const FoundLesion& lesion, double share) const {
    const double threshold = lesion.background + share * (lesion.brightness - lesion.background);
    Mask above = where(allowed_, [&](const Eigen::Vector3d& x, std::size_t v) {
      return allowed_.values[v] && image_.values[v] > threshold &&
             (x - point_).norm() <= search_.reach_mm;
    });
    const Volume<float> depth = inner_distance(above);
    const double opening_mm = std::min(soft_opening_share * lesion.inscribed_mm, most_opening_mm);
    const Volume<float> to_kept = distance_to(component_at(
        where(above, [&](const auto&, std::size_t v) { return depth.values[v] > opening_mm; }),
        core_));
    return where(above, [&](const auto&, std::size_t v) {
      return above.values[v] && to_kept.values[v] <= opening_mm;
    });
  }

 private:
  /// What is over half of the maximum, opened: the part that holds the core, with its lobes or not.
  Mask grow(FoundLesion& lesion, bool with_lobes) {
    const double threshold = (lesion.brightness + lesion.background) / 2;
    Mask above = where(allowed_, [&](const Eigen::Vector3d& x, std::size_t v) {
      return allowed_.values[v] && image_.values[v] > threshold &&
             (x - point_).norm() <= search_.reach_mm;
    });
    above = component_at(above, core_);
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

  /// Parts not far from what was kept of the lesion that are smaller, and as bright.
  Mask lobes_of(const Mask& mask, const Mask& kept, double most_gap_mm,
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

  /// Climbs from the core to the deepest place within its own depth, and moves the core there.
  double deepest_near_core(const Volume<float>& depth) {
    for (int step = 0; step < 50; ++step) {
      const Eigen::Vector3d centre = position(core_);
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

  void measure(const Mask& mask, FoundLesion& lesion) const {
    const Region region(mask, allowed_);
    lesion.brightness = region.brightness(image_, opening_of(lesion));
    lesion.background = region.background(image_).value_or(lesion.background);
  }

  Eigen::Vector3d position(std::size_t v) const {
    const std::size_t nx = image_.size.x(), nxy = nx * image_.size.y();
    return image_.position(static_cast<int>(v % nx), static_cast<int>(v % nxy / nx),
                           static_cast<int>(v / nxy));
  }

  const Volume<float>& image_;
  const Mask& allowed_;
  Eigen::Vector3d point_;
  const LesionSearch& search_;
  std::size_t core_ = 0;
};

/// The voxels on either side of the lesion's surface judged again in the sharp image.
void sharpen_edge(const SharpImage& sharp, const Mask& may, bool brighter, FoundLesion& lesion) {
  const int margin = static_cast<int>(std::ceil(shell_to_mm / may.spacing.minCoeff())) + 1;
  const auto [low, high] = box_around(lesion.mask, margin);
  Volume<float> image = sharp(lesion.low + low, lesion.low + high);
  if (!brighter)
    for (float& value : image.values) value = -value;
  const Mask mask = cropped(lesion.mask, low, high), allowed = cropped(may, low, high);
  const Region region(mask, allowed);
  const double inside = region.brightness(image, opening_of(lesion));
  const double outside = region.background(image).value_or(inside);
  const double beside_mm = 1.01 * mask.spacing.maxCoeff();
  for (int k = 0; k < mask.size.z(); ++k)
    for (int j = 0; j < mask.size.y(); ++j)
      for (int i = 0; i < mask.size.x(); ++i) {
        if (region.depth(i, j, k) > beside_mm || region.away(i, j, k) > beside_mm) continue;
        lesion.mask(low.x() + i, low.y() + j, low.z() + k) =
            allowed(i, j, k) && image(i, j, k) > (inside + outside) / 2;
      }
}

double dice(const Mask& a, const Mask& b) {
  double both = 0, sum = 0;
  for (std::size_t v = 0; v < a.values.size(); ++v)
    both += a.values[v] && b.values[v], sum += a.values[v] + b.values[v];
  return sum > 0 ? 2 * both / sum : 0;
}

Mask walk(const Volume<float>& image, const Mask& allowed, const Mask& region,
          const FoundLesion& lesion) {
  const Volume<float> depth = inner_distance(region), away = distance_to(region);
  const double range = std::abs(lesion.brightness - lesion.background);
  auto seeds = region.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < seeds.values.size(); ++v) {
    if (depth.values[v] > 0.7 * lesion.inscribed_mm) seeds.values[v] = walker_inside;
    if (away.values[v] > shell_to_mm) seeds.values[v] = walker_outside;
  }
  return random_walk(image, allowed, seeds, range);
}

/// Volume of the inscribed ball over that of the lesion.
double compactness(const FoundLesion& lesion, double ml) {
  const double r = lesion.inscribed_mm;
  return 4.0 / 3 * std::numbers::pi * r * r * r / 1000 / ml;
}

/// Along x, y and z [mm]; 0 if empty.
Eigen::Vector3d size_mm(const Mask& mask) {
  const VoxelBox box = box_around(mask, 0);
  if (box.is_empty()) return Eigen::Vector3d::Zero();
  return (box.high - box.low + Eigen::Vector3i::Ones()).cast<double>().cwiseProduct(mask.spacing);
}

/// Does the lesion end at the search's ball rather than at an edge?
bool is_cut_by(double reach, const Eigen::Vector3d& point, const Mask& lesion) {
  const double voxel = std::cbrt(lesion.voxel_volume());
  const Mask last = where(lesion, [&](const Eigen::Vector3d& x, std::size_t v) {
    return lesion.values[v] && (x - point).norm() > reach - voxel;
  });
  return count(last) * voxel * voxel > most_cut_mm2;
}

FoundLesion find_within(const Volume<float>& image, const SharpImage& sharp,
                        const Volume<std::uint8_t>& allowed, const Eigen::Vector3d& point_in_lps,
                        const LesionSearch& search) {
  FoundLesion lesion;
  const double margin = search.reach_mm + shell_to_mm + 4;
  const Eigen::Array3d index = image.index(point_in_lps).array();
  const Eigen::Array3d extent = margin / image.spacing.array();
  lesion.low = (index - extent).floor().max(0).cast<int>().matrix();
  const Eigen::Vector3i high =
      (index + extent).ceil().min((image.size.array() - 1).cast<double>()).cast<int>().matrix();
  Volume<float> part = cropped(image, lesion.low, high);
  const Mask may = cropped(allowed, lesion.low, high);
  constexpr float top = 10;  // fat is at 1: dark lesions are looked for in the negative
  if (!search.brighter)
    for (float& value : part.values) value = top - value;
  part = gaussian_smoothed(std::move(part), smoothing_mm);

  HalfMaximum half_maximum(part, may, point_in_lps, search);
  lesion.mask = half_maximum.run(lesion);
  const Mask soft = half_maximum.at_share(lesion, soft_share);
  if (count(lesion.mask) > 0) sharpen_edge(sharp, may, search.brighter, lesion);
  const double ml = count(lesion.mask) * image.voxel_volume() / 1000;
  if (ml < least_ml || lesion.brightness - lesion.background < least_contrast ||
      (!search.brighter && compactness(lesion, ml) < least_compact)) {
    lesion.is_sphere = true;
    lesion.mask = where(may, [&](const Eigen::Vector3d& x, std::size_t v) {
      return may.values[v] && (x - point_in_lps).norm() <= fallback_mm;
    });
  } else {
    lesion.is_cut = is_cut_by(search.reach_mm, point_in_lps, lesion.mask);
    const Mask walked = walk(part, may, lesion.mask, lesion);
    lesion.agreement = dice(lesion.mask, walked);
    lesion.soft_extent_mm = size_mm(soft);
    if (search.random_walker && count(walked) > 0) lesion.mask = walked;
  }
  lesion.extent_mm = size_mm(lesion.mask);
  if (!search.brighter) {
    lesion.brightness = top - lesion.brightness;
    lesion.background = top - lesion.background;
  }
  return lesion;
}

}  // namespace

bool FoundLesion::is_soft() const {
  constexpr double most_mm = 3, most_share = 0.2;
  const Eigen::Array3d more = (soft_extent_mm - extent_mm).array();
  return (more > most_mm && more > most_share * extent_mm.array()).any();
}

FoundLesion find_lesion(const Volume<float>& image, const SharpImage& sharp,
                        const Volume<std::uint8_t>& allowed, const Eigen::Vector3d& point_in_lps,
                        const LesionSearch& search) {
  LesionSearch usual = search;
  usual.reach_mm = std::min(search.reach_mm, usual_reach_mm);
  FoundLesion lesion = find_within(image, sharp, allowed, point_in_lps, usual);
  if (lesion.is_cut && search.reach_mm > usual.reach_mm)
    lesion = find_within(image, sharp, allowed, point_in_lps, search);
  return lesion;
}

}  // namespace mammotwin
