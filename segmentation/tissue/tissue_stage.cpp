#include "segmentation/tissue/tissue_stage.h"

#include "segmentation/image/crop.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/restored_image.h"
#include "segmentation/tissue/vessels.h"

namespace mammotwin {
namespace {

constexpr double lesion_left_out_mm = 2.5;
constexpr double skin_blur_mm = 1;    // beyond the skin, its blur would pass for gland
constexpr double wall_blur_mm = 1.5;  // in front of the wall, muscle's

}  // namespace

TissueMasks tissue_masks(const HalfBreast& half, const Volume<float>& enhancement,
                         const Volume<std::uint8_t>& lesions, double skin_mm) {
  const Volume<float> to_lesion = distance_to(lesions);
  TissueMasks masks{half.inside, pure_interior(half)};
  for (std::size_t v = 0; v < lesions.values.size(); ++v) {
    masks.interior.values[v] &= half.depth.values[v] > skin_mm + skin_blur_mm &&
                                half.above_wall.values[v] > wall_blur_mm && lesions.values[v] == 0;
    masks.statistics.values[v] &=
        to_lesion.values[v] > lesion_left_out_mm &&
        (enhancement.values.empty() || enhancement.values[v] < vessel_uptake);
  }
  return masks;
}

Volume<float> restored_within(const Volume<std::uint8_t>& interior, const Volume<float>& image,
                              const TissueImage& tissue) {
  Volume<float> out = image;
  const VoxelBox box = box_around(interior, 0);
  if (box.is_empty()) return out;
  const auto& [low, high] = box;
  const Volume<float> clean =
      restored_image(cropped(tissue.image, box), cropped(tissue.noise, box));
  for (int k = low.z(); k <= high.z(); ++k)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int i = low.x(); i <= high.x(); ++i)
        if (interior(i, j, k)) out(i, j, k) = clean(i - low.x(), j - low.y(), k - low.z());
  return out;
}

Segmentation labelled(const HalfBreast& half, const Volume<float>& skin_depth, double skin_mm,
                      const Volume<std::uint8_t>& lesions, const TissueSplit& split) {
  Segmentation s;
  s.region.side = half.side;
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
      value = skin_depth.values[v] < skin_mm ? label::skin
              : gland > 0.5F                 ? label::fibroglandular
                                             : label::fat;
      s.fractions.values[v] = {1 - gland, gland, 0};
    }
  }
  return s;
}

Volume<float> corrected_like(const TissueSplit& split, const Volume<float>& restored,
                             Volume<float> image) {
  for (std::size_t v = 0; v < restored.values.size(); ++v)
    if (restored.values[v] > 0) image.values[v] *= split.corrected.values[v] / restored.values[v];
  return image;
}

}  // namespace mammotwin
