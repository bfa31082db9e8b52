#include "segmentation/lesion/lesion_stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "segmentation/image/crop.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/restored_image.h"
#include "segmentation/lesion/lesion.h"
#include "segmentation/mirrored.h"

namespace mammotwin {
namespace {

constexpr double outside_tolerance_mm = 4;  // a click on the edge is no error
constexpr double least_agreement = 0.5, least_contrast_if_brighter = 1.3;
constexpr double least_radius_mm = 5;  // of what is shown of a doubtful lesion

std::string text(const Eigen::Vector3d& x) {
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(1);
  out << "[" << x.x() << ", " << x.y() << ", " << x.z() << "]";
  return out.str();
}

void check_inside(const HalfBreast& half, const Volume<float>& to_inside, const PlacedSeed& seed,
                  bool in_mirror) {
  const Eigen::Vector3i v = half.inside.index(seed.point_in_lps).array().round().cast<int>();
  const bool on_grid = half.inside.contains(v.x(), v.y(), v.z());
  const double off = on_grid ? to_inside(v.x(), v.y(), v.z()) : INFINITY;
  if (off <= outside_tolerance_mm) return;
  std::ostringstream message;
  message << "lesion " << seed.id << " at "
          << text(in_mirror ? mirrored(seed.point_in_lps) : seed.point_in_lps) << " mm lies ";
  if (std::isfinite(off)) {
    message.precision(2);
    message << off << " mm ";
  }
  message
      << "outside the " << to_string(in_mirror ? mirrored(half.side) : half.side) << " breast"
      << (on_grid && half.body(v.x(), v.y(), v.z()) ? ", behind the chest wall" : "")
      << "; expected a point between its skin and chest wall in LPS [mm] (is it in cm, in RAS, or "
         "of the other side?)";
  throw std::runtime_error(message.str());
}

std::size_t paint_given(const PlacedSeed& seed, std::uint8_t value, const HalfBreast& half,
                        Volume<std::uint8_t>& lesions) {
  std::size_t painted = 0;
  for (int k = 0; k < lesions.size.z(); ++k)
    for (int j = 0; j < lesions.size.y(); ++j)
      for (int i = 0; i < lesions.size.x(); ++i)
        if (half.inside(i, j, k) && seed.holds(lesions.position(i, j, k)))
          lesions(i, j, k) = value, ++painted;
  return painted;
}

/// What contrast agent adds, bias corrected. A voxel's part of it is the lesion's part in the
/// voxel, which is not so of the ratio to the image before: fat is twice as bright there as a
/// lesion.
Volume<float> subtraction(const HalfImages& images) {
  Volume<float> added = images.denoised;
  for (std::size_t v = 0; v < added.values.size(); ++v)
    added.values[v] *= images.enhancement.values[v] / (1 + images.enhancement.values[v]);
  return added;
}

/// What lesions stand out in, restored: the image, or what contrast agent added to it.
SharpImage sharp_image(const HalfImages& images) {
  if (images.pre.values.empty())
    return [&images](const auto& low, const auto& high) {
      return restored_image(cropped(images.noisy, low, high), cropped(images.noise, low, high));
    };
  return [&images](const auto& low, const auto& high) {
    Volume<float> added = cropped(images.noisy, low, high),
                  noise = cropped(images.noise, low, high);
    const Volume<float> before = cropped(images.pre, low, high);
    for (std::size_t v = 0; v < added.values.size(); ++v) {
      added.values[v] -= before.values[v];
      noise.values[v] *= std::numbers::sqrt2_v<float>;
    }
    return restored_image(added, noise);
  };
}

std::string extent_text(const Eigen::Vector3d& mm) {
  std::ostringstream out;
  out << std::lround(mm.x()) << " x " << std::lround(mm.y()) << " x " << std::lround(mm.z())
      << " mm";
  return out.str();
}

void judge(const FoundLesion& found, const PlacedSeed& seed, bool brighter,
           SegmentQuality& quality) {
  quality.lesion_agreement.push_back(found.agreement);
  const auto doubt = [&](const std::string& reason) {
    quality.doubt(SegmentStatus::look,
                  {"lesion " + seed.id, "lesion " + seed.id + reason, seed.point_in_lps,
                   std::max(found.inscribed_mm, least_radius_mm)});
  };
  if (found.is_sphere) {
    doubt(
        " does not stand out from its surroundings: a ball of 5 mm round the point was taken; give "
        "radius_mm or a label map");
    return;
  }
  if (!brighter)
    doubt(
        " was outlined without fat suppression and contrast agent, where it looks like gland: its "
        "extent rests on the fat around it; give radius_mm or a label map if it lies in gland");
  if (brighter && found.contrast() < least_contrast_if_brighter)
    doubt(" is less than 1.3 times as bright as its surroundings: its edge is uncertain");
  if (brighter && found.is_soft())
    quality.notes.push_back("lesion " + seed.id + " measures " + extent_text(found.extent_mm) +
                            " along x, y and z at half of its contrast and " +
                            extent_text(found.soft_extent_mm) +
                            " at three tenths: a contour drawn by hand may lie anywhere between");
  if (found.is_cut)
    doubt(
        " goes on where the search for it ends: raise segment.lesion_reach_mm, or give a label "
        "map");
  if (found.agreement < least_agreement)
    doubt(": two methods disagree on its extent (Dice under 0.5)");
}

/// Labels lesion n; a voxel that an earlier one has, too, stays with the nearer point: lesions
/// close to each other are both kept, and meet half-way.
void paint_found(const FoundLesion& found, const std::vector<PlacedSeed>& seeds, std::size_t n,
                 Volume<std::uint8_t>& lesions) {
  const auto away = [&](std::size_t seed, const Eigen::Vector3d& x) {
    return (x - seeds[seed].point_in_lps).squaredNorm();
  };
  for (int k = 0; k < found.mask.size.z(); ++k)
    for (int j = 0; j < found.mask.size.y(); ++j)
      for (int i = 0; i < found.mask.size.x(); ++i) {
        if (!found.mask(i, j, k)) continue;
        const Eigen::Vector3i v = found.low + Eigen::Vector3i(i, j, k);
        std::uint8_t& value = lesions(v.x(), v.y(), v.z());
        const Eigen::Vector3d x = lesions.position(v.x(), v.y(), v.z());
        if (value == 0 || away(n, x) < away(value - label::lesion, x))
          value = static_cast<std::uint8_t>(label::lesion + n);
      }
}

}  // namespace

void check_seeds(const HalfBreast& half, const std::vector<PlacedSeed>& seeds, bool in_mirror) {
  if (seeds.empty()) return;
  const Volume<float> to_inside = distance_to(half.inside);
  for (const PlacedSeed& seed : seeds) check_inside(half, to_inside, seed, in_mirror);
}

Volume<std::uint8_t> find_lesions(const HalfBreast& half, const HalfImages& images,
                                  const std::vector<PlacedSeed>& seeds, bool fat_suppressed,
                                  const SegmentOptions& options, SegmentQuality& quality) {
  const bool by_enhancement = !images.enhancement.values.empty();
  const bool brighter = fat_suppressed || by_enhancement;
  const Volume<float> uptake = by_enhancement ? subtraction(images) : Volume<float>();
  const SharpImage sharp = sharp_image(images);
  auto lesions = half.body.like<std::uint8_t>(0);
  constexpr double below_skin_mm = 2.5;  // skin is as bright as a lesion
  auto allowed = half.inside;
  for (std::size_t v = 0; v < allowed.values.size(); ++v)
    allowed.values[v] &= half.depth.values[v] > below_skin_mm;

  for (std::size_t n = 0; n < seeds.size(); ++n) {
    const PlacedSeed& seed = seeds[n];
    const auto value = static_cast<std::uint8_t>(label::lesion + n);
    if (seed.radius_mm || seed.mask) {
      if (paint_given(seed, value, half, lesions) == 0)
        throw std::runtime_error("lesion " + seed.id +
                                 " holds no voxel of the breast; expected a "
                                 "larger radius or another label map");
      continue;
    }
    LesionSearch search;
    search.reach_mm = options.lesion_reach_mm;
    search.brighter = brighter;
    search.random_walker = options.lesion_method == LesionMethod::random_walker;
    const FoundLesion found = find_lesion(by_enhancement ? uptake : images.denoised, sharp, allowed,
                                          seed.point_in_lps, search);
    judge(found, seed, brighter, quality);
    paint_found(found, seeds, n, lesions);
  }
  return lesions;
}

}  // namespace mammotwin
