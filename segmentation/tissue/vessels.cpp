#include "segmentation/tissue/vessels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
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
constexpr double stands_out = 0.2;   // of bright gland's contrast to fat, or of `vessel_uptake`
constexpr double brighter = 1.25;    // than pure gland, where it runs through fat ...
constexpr double more_in_gland = 5;  // ... and of bright gland for each share of gland around
constexpr double around_block_mm = 3, around_mm = 10;
constexpr float brightest = 6;   // of fat: a very bright lesion has no halo
constexpr double wall_mm = 1.5;  // from a tube's core to where it ends
constexpr double least_length_mm = 15;
constexpr double surroundings_mm = 3;

/// An image in which vessels stand out, and where it is as bright as they are.
struct VesselImage {
  Volume<float> image;
  Mask bright;
  double least_response;
};

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

VesselImage by_brightness(Volume<float> image, const Volume<float>& fraction, const Mask& interior,
                          double gland) {
  auto bright = interior;
  const double bright_gland = std::max(bright_contrast(image, fraction, interior), gland - 1);
  const Volume<float> around = smooth_field(fraction, interior, around_block_mm, around_mm);
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        image(i, j, k) = std::clamp(image(i, j, k), 0.0F, brightest);
        if (!bright(i, j, k)) continue;
        const double gland_around = interpolated(around, image.position(i, j, k));
        const double in_fat = brighter * (gland - 1), in_gland = more_in_gland * bright_gland;
        bright(i, j, k) = image(i, j, k) > 1 + in_fat + in_gland * gland_around;
      }
  return {std::move(image), std::move(bright), stands_out * bright_gland};
}

VesselImage by_uptake(Volume<float> enhancement, const Mask& interior) {
  auto bright = interior;
  for (std::size_t v = 0; v < bright.values.size(); ++v)
    bright.values[v] &= enhancement.values[v] > vessel_uptake;
  return {std::move(enhancement), std::move(bright), stands_out * vessel_uptake};
}

/// Bright voxels on a tube of any scale.
Mask tube_cores(const VesselImage& vessels) {
  auto cores = vessels.bright.like<std::uint8_t>(0);
  const Eigen::Vector3i& n = cores.size;
  const Eigen::Vector3d& h = cores.spacing;
  for (const double sigma_mm : scales_mm) {
    const std::vector<float> response =
        tube_response({n.x(), n.y(), n.z()}, {h.x(), h.y(), h.z()}, vessels.image.values,
                      vessels.bright.values, sigma_mm);
    for (std::size_t v = 0; v < response.size(); ++v)
      cores.values[v] |= response[v] > vessels.least_response;
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

Mask find_vessels(const TissueSplit& split, const Mask& interior,
                  const Volume<float>& enhancement) {
  auto vessels = interior.like<std::uint8_t>(0);
  const int margin = 8;  // voxels: beyond the reach of the widest scale
  const VoxelBox box = box_around(interior, margin);
  if (box.is_empty()) return vessels;
  const Mask within = cropped(interior, box);
  const Mask cores =
      tube_cores(enhancement.values.empty()
                     ? by_brightness(cropped(split.corrected, box),
                                     cropped(split.gland_fraction, box), within, split.gland)
                     : by_uptake(cropped(enhancement, box), within));
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

double volume_in(const BreastRegion& region, const Mask& mask) {
  double voxels = 0;
  for (int k = 0; k < mask.size.z(); ++k)
    for (int j = 0; j < mask.size.y(); ++j)
      for (int i = 0; i < mask.size.x(); ++i)
        voxels += mask(i, j, k) && region.contains(mask.position(i, j, k));
  return voxels * mask.voxel_volume() / 1000;
}

}  // namespace mammotwin
