#include "segmentation/tissue/vessels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "segmentation/image/components.h"
#include "segmentation/image/crop.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/masked.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/image/tube_response.h"

namespace mammotwin {
namespace {

using Mask = Volume<std::uint8_t>;

constexpr double scales_mm[] = {1, 2};
constexpr double stands_out = 0.2;   // of bright gland's contrast to fat
constexpr double brighter = 1.25;    // than pure gland, where it runs through fat ...
constexpr double more_in_gland = 5;  // ... and of bright gland for each share of gland around
constexpr double around_block_mm = 3, around_mm = 10;
constexpr float brightest = 6;   // of fat: a very bright lesion has no halo
constexpr double wall_mm = 1.5;  // from a tube's core to where it ends
constexpr double least_length_mm = 15;
constexpr double surroundings_mm = 3;

/// How much brighter than fat bright gland is: the upper quartile of what is mostly gland.
double bright_contrast(const Volume<float>& image, const Volume<float>& fraction,
                       const Mask& interior) {
  constexpr float mostly = 0.75F;
  constexpr double upper_quartile = 0.75;
  auto gland = interior;
  for (std::size_t v = 0; v < gland.values.size(); ++v)
    gland.values[v] &= fraction.values[v] > mostly;
  std::vector<float> values = values_in(image, gland);
  return values.empty() ? 0 : quantile(values, upper_quartile) - 1;
}

/// Bright voxels on a tube of any scale.
Mask tube_cores(Volume<float> image, const Volume<float>& fraction, const Mask& interior,
                double gland) {
  auto bright = interior;
  const double contrast = bright_contrast(image, fraction, interior);
  if (contrast <= 0) return interior.like<std::uint8_t>(0);
  const Volume<float> around = smooth_field(fraction, interior, around_block_mm, around_mm);
  for (float& value : image.values) value = std::clamp(value, 0.0F, brightest);
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        if (!bright(i, j, k)) continue;
        const double gland_around = interpolated(around, image.position(i, j, k));
        const double in_fat = brighter * (gland - 1), in_gland = more_in_gland * contrast;
        bright(i, j, k) = image(i, j, k) > 1 + in_fat + in_gland * gland_around;
      }
  auto cores = bright.like<std::uint8_t>(0);
  const Eigen::Vector3i& n = image.size;
  const Eigen::Vector3d& h = image.spacing;
  for (const double sigma_mm : scales_mm) {
    const std::vector<float> response = tube_response({n.x(), n.y(), n.z()}, {h.x(), h.y(), h.z()},
                                                      image.values, bright.values, sigma_mm);
    for (std::size_t v = 0; v < response.size(); ++v)
      cores.values[v] |= response[v] > stands_out * contrast;
  }
  return cores;
}

/// Parts of a mask whose box has a diagonal of at least `least_mm`.
Mask long_parts(const Mask& mask, double least_mm) {
  const Components parts = connected_components(mask);
  std::vector<Eigen::AlignedBox3d> boxes(parts.sizes.size());
  const auto for_each = [&](const auto& visit) {
    for (int k = 0; k < mask.size.z(); ++k)
      for (int j = 0; j < mask.size.y(); ++j)
        for (int i = 0; i < mask.size.x(); ++i)
          if (mask(i, j, k)) visit(i, j, k, boxes[parts.ids(i, j, k)]);
  };
  for_each([&](int i, int j, int k, auto& box) { box.extend(mask.position(i, j, k)); });
  auto kept = mask.like<std::uint8_t>(0);
  for_each([&](int i, int j, int k, const auto& box) {
    kept(i, j, k) = box.diagonal().norm() >= least_mm;
  });
  return kept;
}

}  // namespace

Mask find_vessels(const TissueSplit& split, const Mask& interior) {
  auto vessels = interior.like<std::uint8_t>(0);
  const int margin = 8;  // voxels: beyond the reach of the widest scale
  const VoxelBox box = box_around(interior, margin);
  if (box.is_empty()) return vessels;
  const Mask within = cropped(interior, box);
  const Mask cores = tube_cores(cropped(split.corrected, box), cropped(split.gland_fraction, box),
                                within, split.gland);
  if (std::none_of(cores.values.begin(), cores.values.end(), [](auto v) { return v != 0; }))
    return vessels;
  const Volume<float> to_core = distance_to(cores);
  auto found = within;
  for (std::size_t v = 0; v < found.values.size(); ++v)
    found.values[v] &= to_core.values[v] <= wall_mm;
  found = long_parts(found, least_length_mm + 2 * wall_mm);
  std::size_t n = 0;
  for (int k = box.low.z(); k <= box.high.z(); ++k)
    for (int j = box.low.y(); j <= box.high.y(); ++j)
      for (int i = box.low.x(); i <= box.high.x(); ++i) vessels(i, j, k) = found.values[n++];
  return vessels;
}

void take_as_surroundings(const Mask& vessels, const Mask& interior, TissueSplit& split) {
  auto weight = split.gland_fraction.like<float>(0);
  for (std::size_t v = 0; v < weight.values.size(); ++v)
    weight.values[v] = interior.values[v] && !vessels.values[v];
  const Volume<float> around = weighted_smoothed(split.gland_fraction, weight, surroundings_mm);
  for (std::size_t v = 0; v < weight.values.size(); ++v)
    if (vessels.values[v]) split.gland_fraction.values[v] = around.values[v];
}

}  // namespace mammotwin
