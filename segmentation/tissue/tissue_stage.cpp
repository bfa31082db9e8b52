#include "segmentation/tissue/tissue_stage.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "segmentation/image/crop.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/restored_image.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/tissue/fibroglandular.h"

namespace mammotwin {
namespace {

constexpr double skin_left_out_mm = 4, wall_left_out_mm = 2, lesion_left_out_mm = 2.5;
constexpr float vessel_enhancement = 1;  // vessels and lesions would lift gland's brightness
constexpr double skin_blur_mm = 1;       // beyond the skin, its blur would pass for gland
constexpr double wall_blur_mm = 1.5;     // in front of the wall, muscle's
constexpr double usual_skin_mm = 1.5;

double judge_skin(const SkinSlab& skin, const SegmentOptions& options, SegmentQuality& quality) {
  if (options.skin_thickness_mm) return quality.skin_thickness_mm = *options.skin_thickness_mm;
  constexpr double largest_misfit = 0.15, thick_mm = 4;
  if (!(skin.thickness > 0) || skin.misfit > largest_misfit) {
    quality.doubt(SegmentStatus::look,
                  "the skin's thickness could not be measured: 1.5 mm was "
                  "taken; set segment.skin_thickness_mm where known");
    return quality.skin_thickness_mm = usual_skin_mm;
  }
  if (skin.thickness > thick_mm)
    quality.doubt(SegmentStatus::look,
                  "the skin measures more than 4 mm; expected 1 to 3 mm (is it swollen, or does "
                  "gland lie right under it?)");
  if (!skin.over_fat)
    quality.doubt(
        SegmentStatus::look,
        "gland lies under nearly all of the skin and may pass for it: the skin's thickness "
        "is not known; set segment.skin_thickness_mm where it is");
  quality.skin_thickness_low_mm = skin.over_fat ? skin.low : thinnest_measured_skin_mm;
  quality.skin_thickness_high_mm = skin.over_fat ? skin.high : thickest_measured_skin_mm;
  return quality.skin_thickness_mm = skin.thickness;
}

/// Volume [ml] that is brighter than twice fat after smoothing by 6 mm: suppression has failed.
double failed_suppression_ml(const Volume<float>& image, const Volume<std::uint8_t>& interior) {
  constexpr double block_mm = 3, smoothing_mm = 6, alarm = 2;
  Volume<float> share;
  const Volume<float> coarse = block_means(image, interior, block_mm, share);
  const Volume<float> smooth = weighted_smoothed(coarse, share, smoothing_mm);
  double count = 0;
  for (std::size_t v = 0; v < smooth.values.size(); ++v)
    if (smooth.values[v] > alarm) count += share.values[v];
  return count * smooth.voxel_volume() / 1000;
}

void judge_suppression(const Volume<float>& image, const Volume<std::uint8_t>& interior,
                       SegmentQuality& quality) {
  constexpr double alarm_ml = 5;  // study: 0 to 2.4 where it worked, 66 to 126 where it failed
  const double ml = failed_suppression_ml(image, interior);
  quality.failed_suppression_ml = ml;
  if (ml <= alarm_ml) return;
  std::ostringstream reason;
  reason.setf(std::ios::fixed);
  reason.precision(0);
  reason << "fat suppression seems to have failed in " << ml
         << " ml of the breast: bright fat there passes for fibroglandular tissue";
  quality.doubt(SegmentStatus::look, reason.str());
}

/// The image, and the scan of tissue restored within `interior`.
Volume<float> restored(const HalfBreast& half, const TissueImage& scan,
                       const Volume<std::uint8_t>& interior) {
  Volume<float> image = half.image;
  const VoxelBox box = box_around(interior, 0);
  const auto [low, high] = box;
  if (box.is_empty()) return image;
  const Volume<float> clean =
      restored_image(cropped(scan.image, low, high), cropped(scan.noise, low, high));
  for (int k = low.z(); k <= high.z(); ++k)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int i = low.x(); i <= high.x(); ++i)
        if (interior(i, j, k)) image(i, j, k) = clean(i - low.x(), j - low.y(), k - low.z());
  return image;
}

}  // namespace

void label_tissue(const HalfBreast& half, const TissueImage& scan,
                  const Volume<std::uint8_t>& lesions, bool fat_suppressed,
                  const SegmentOptions& options, SegmentResult& result) {
  const double skin = judge_skin(half.skin, options, result.quality);
  const Volume<float> to_lesion = distance_to(lesions);
  auto interior = half.inside, statistics = half.inside;
  for (std::size_t v = 0; v < interior.values.size(); ++v) {
    const float depth = half.depth.values[v], above = half.above_wall.values[v];
    interior.values[v] &=
        depth > skin + skin_blur_mm && above > wall_blur_mm && lesions.values[v] == 0;
    statistics.values[v] &=
        depth > skin_left_out_mm && above > wall_left_out_mm &&
        to_lesion.values[v] > lesion_left_out_mm &&
        (half.enhancement.values.empty() || half.enhancement.values[v] < vessel_enhancement);
  }
  const Volume<float> clean = restored(half, scan, interior);
  const TissueSplit split = split_tissue(clean, interior, statistics, fat_suppressed);
  if (fat_suppressed) judge_suppression(half.widely_corrected, statistics, result.quality);

  Segmentation& s = result.segmentation;
  s.labels = half.body.like<std::uint8_t>(label::air);
  s.fractions = half.body.like<Fractions>();
  for (std::size_t v = 0; v < s.labels.values.size(); ++v) {
    if (!half.body.values[v]) continue;
    std::uint8_t& value = s.labels.values[v];
    const float gland = split.gland_fraction.values[v];
    if (!half.inside.values[v]) {
      value = label::muscle;
    } else if (lesions.values[v]) {
      value = lesions.values[v];
      s.fractions.values[v] = {0, 0, 1};
    } else {
      value = half.skin_depth.values[v] < skin ? label::skin
              : gland > 0.5F                   ? label::fibroglandular
                                               : label::fat;
      s.fractions.values[v] = {1 - gland, gland, 0};
    }
  }
  result.image = half.image;
  for (std::size_t v = 0; v < clean.values.size(); ++v)
    if (clean.values[v] > 0) result.image.values[v] *= split.corrected.values[v] / clean.values[v];
}

}  // namespace mammotwin
