#include "segmentation/lesion/lesion_seed.h"

#include <stdexcept>

#include "segmentation/files/markups.h"
#include "segmentation/files/read_labels.h"
#include "segmentation/mirrored.h"

namespace mammotwin {
namespace {

PlacedSeed seed_of_map(const LesionSeed& seed) {
  const std::uint16_t value = seed.label_value.value_or(1);
  const Volume<std::uint16_t> map = read_labels(*seed.label_map);
  PlacedSeed placed{seed.id, Eigen::Vector3d::Zero(), std::nullopt, map.like<std::uint8_t>(0)};
  double count = 0;
  for (int k = 0; k < map.size.z(); ++k)
    for (int j = 0; j < map.size.y(); ++j)
      for (int i = 0; i < map.size.x(); ++i) {
        if (map(i, j, k) != value) continue;
        (*placed.mask)(i, j, k) = 1;
        placed.point_in_lps += map.position(i, j, k);
        ++count;
      }
  if (count == 0)
    throw std::runtime_error(seed.label_map->string() + ": holds no voxel of value " +
                             std::to_string(value) + "; expected the lesion " + seed.id);
  placed.point_in_lps /= count;
  return placed;
}

}  // namespace

bool PlacedSeed::holds(const Eigen::Vector3d& x_in_lps) const {
  if (radius_mm && (x_in_lps - point_in_lps).norm() <= *radius_mm) return true;
  if (!mask) return false;
  const Eigen::Vector3i v = mask->index(x_in_lps).array().round().cast<int>();
  return mask->contains(v.x(), v.y(), v.z()) && (*mask)(v.x(), v.y(), v.z());
}

PlacedSeed place_seed(const LesionSeed& seed) {
  if (seed.label_map) return seed_of_map(seed);
  if (seed.point_in_lps) return {seed.id, *seed.point_in_lps, seed.radius_mm, std::nullopt};
  if (seed.markups)
    return {seed.id, read_markups_point(*seed.markups), seed.radius_mm, std::nullopt};
  throw std::invalid_argument("lesion " + seed.id +
                              " has no place; expected a point, a markups file or a label map");
}

PlacedSeed mirrored(PlacedSeed seed) {
  seed.point_in_lps = mirrored(seed.point_in_lps);
  if (seed.mask) seed.mask = mirrored(*seed.mask);
  return seed;
}

}  // namespace mammotwin
