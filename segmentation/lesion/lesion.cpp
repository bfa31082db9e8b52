#include "segmentation/lesion/lesion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "segmentation/image/crop.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/lesion/half_maximum.h"
#include "segmentation/lesion/lesion_region.h"
#include "segmentation/lesion/random_walker.h"

namespace mammotwin {
namespace {

using Mask = Volume<std::uint8_t>;

constexpr double smoothing_mm = 0.4;
constexpr double usual_reach_mm = 30, most_cut_mm2 = 100;
// Of the contrast. Chosen on six contours of radiologists: two lesions are found over 3 mm and 20 %
// smaller than drawn, and both are said to be soft.
constexpr double soft_share = 0.3;
constexpr double least_ml = 0.03;
constexpr double fallback_mm = 5;
constexpr double least_compact = 0.3;    // dark parts below are gland, not a lesion
constexpr double least_contrast = 0.15;  // over the surroundings, else nothing stands out

/// The voxels on either side of the lesion's surface judged again in the sharp image.
void sharpen_edge(const SharpImage& sharp, const Mask& may, bool brighter, FoundLesion& lesion) {
  const int margin = static_cast<int>(std::ceil(shell_to_mm / may.spacing.minCoeff())) + 1;
  const auto [low, high] = box_around(lesion.mask, margin);
  Volume<float> image = sharp(lesion.low + low, lesion.low + high);
  if (!brighter)
    for (float& value : image.values) value = -value;
  const Mask mask = cropped(lesion.mask, low, high), allowed = cropped(may, low, high);
  const LesionRegion region(mask, allowed);
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
