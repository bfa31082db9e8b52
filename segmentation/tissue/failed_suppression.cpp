#include "segmentation/tissue/failed_suppression.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "segmentation/image/components.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

constexpr double block_mm = 3, smoothing_mm = 6, bright = 2, brightish = 1.5, rim_mm = 9;
constexpr double least_part_ml = 1;
constexpr double alarm_ml = 5;  // where it works: less on each of 32 simulated images
// Local minima over means: 0.74 and 0.77 in two parts of fat, 0.39 and 0.59 where gland and a
// tumour's surroundings were as bright, with dark fat between their strands.
constexpr double evenness = 0.65;
constexpr double layer_mm = 10;       // below the skin: fat, but for ducts at the nipple
constexpr double layer_share = 0.25;  // of bright fat; bright gland and lesions lie deeper
// Even gland of dense breasts reaches into the layer, too (0.30 of it, 1.3 times gland's contrast
// in a drawn one); parts that were fat had 0.73 and more in it, or were 1.9 times as bright.
constexpr double fat_layer_share = 0.6, brighter_than_gland = 1.5;

/// Least value in the cube of 3 voxels a side.
Volume<float> local_minimum(Volume<float> image) {
  for (float& value : image.values) value = -value;
  image = local_maximum(std::move(image), 1);
  for (float& value : image.values) value = -value;
  return image;
}

/// What is looked at, on blocks of 3 mm.
struct Coarse {
  Volume<float> share, depth;  ///< of each block in the breast; mean depth
  Volume<float> mean, least;   ///< smoothed: of values, of local minima

  Coarse(const Volume<float>& image, const Volume<std::uint8_t>& mask,
         const Volume<float>& depth_mm)
      : depth(block_means(depth_mm, mask, block_mm, share)) {
    mean = weighted_smoothed(block_means(image, mask, block_mm, share), share, smoothing_mm);
    least = weighted_smoothed(block_means(local_minimum(image), mask, block_mm, share), share,
                              smoothing_mm);
  }
};

/// One part of what is bright.
struct Part {
  double voxels = 0, in_layer = 0, mean = 0, least = 0;

  bool is_fat(double voxel_ml, double gland) const {
    const bool is_gland = in_layer < fat_layer_share * voxels &&
                          mean / voxels - 1 < brighter_than_gland * (gland - 1);
    return !is_gland && voxels * voxel_ml >= least_part_ml && in_layer >= layer_share * voxels &&
           least >= evenness * mean;
  }
};

/// Of a mask on the blocks, the parts that are fat.
Volume<std::uint8_t> parts_of_fat(const Volume<std::uint8_t>& mask, const Coarse& coarse,
                                  double gland) {
  const Components components = connected_components(mask);
  std::vector<Part> parts(components.sizes.size());
  for (std::size_t v = 0; v < mask.values.size(); ++v) {
    if (!mask.values[v]) continue;
    Part& part = parts[components.ids.values[v]];
    const float share = coarse.share.values[v];
    part.voxels += share;
    part.mean += share * coarse.mean.values[v];
    part.least += share * coarse.least.values[v];
    if (coarse.depth.values[v] < layer_mm) part.in_layer += share;
  }
  auto kept = mask.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < mask.values.size(); ++v) {
    if (!mask.values[v]) continue;
    kept.values[v] = parts[components.ids.values[v]].is_fat(mask.voxel_volume() / 1000, gland);
  }
  return kept;
}

}  // namespace

Volume<std::uint8_t> failed_suppression(const Volume<float>& image,
                                        const Volume<std::uint8_t>& statistics,
                                        const Volume<std::uint8_t>& interior,
                                        const Volume<float>& depth, double gland) {
  const Coarse coarse(image, statistics, depth);
  auto core = coarse.mean.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < core.values.size(); ++v)
    core.values[v] = coarse.mean.values[v] > bright && coarse.share.values[v] > 0;
  core = parts_of_fat(core, coarse, gland);
  auto failed = interior.like<std::uint8_t>(0);
  if (std::none_of(core.values.begin(), core.values.end(), [](auto c) { return c != 0; }))
    return failed;
  const Volume<float> to_core = distance_to(core);
  for (int k = 0; k < failed.size.z(); ++k)
    for (int j = 0; j < failed.size.y(); ++j)
      for (int i = 0; i < failed.size.x(); ++i) {
        if (!interior(i, j, k)) continue;
        const Eigen::Vector3i v = core.index(failed.position(i, j, k)).array().round().cast<int>();
        failed(i, j, k) = core.contains(v.x(), v.y(), v.z()) &&
                          to_core(v.x(), v.y(), v.z()) <= rim_mm &&
                          coarse.mean(v.x(), v.y(), v.z()) > brightish;
      }
  return failed;
}

void judge_suppression(const Volume<std::uint8_t>& failed, double sternal_y,
                       SegmentQuality& quality) {
  auto hanging = failed;
  for (int k = 0; k < hanging.size.z(); ++k)
    for (int j = 0; j < hanging.size.y(); ++j)
      for (int i = 0; i < hanging.size.x(); ++i)
        hanging(i, j, k) &= hanging.position(i, j, k).y() < sternal_y;
  const auto ml_of = [&](double voxels) { return voxels * failed.voxel_volume() / 1000; };
  const Components parts = connected_components(hanging);
  const std::int32_t largest = parts.largest();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double voxels = 0;
  for (int k = 0; k < hanging.size.z(); ++k)
    for (int j = 0; j < hanging.size.y(); ++j)
      for (int i = 0; i < hanging.size.x(); ++i) {
        voxels += hanging(i, j, k);
        if (largest > 0 && parts.ids(i, j, k) == largest) sum += hanging.position(i, j, k);
      }
  quality.failed_suppression_ml = ml_of(voxels);
  if (*quality.failed_suppression_ml <= alarm_ml) return;
  const double in_largest = static_cast<double>(parts.sizes[largest]);
  std::ostringstream reason;
  reason.setf(std::ios::fixed);
  reason.precision(0);
  reason << "fat suppression seems to have failed in " << *quality.failed_suppression_ml
         << " ml of the breast: they are taken as fat, and gland in them is not seen";
  quality.doubt(SegmentStatus::look, {"fat suppression", reason.str(), sum / in_largest,
                                      ball_radius_mm(ml_of(in_largest))});
}

}  // namespace mammotwin
