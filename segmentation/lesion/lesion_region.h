#pragma once

#include <cstdint>
#include <optional>

#include "segmentation/lesion/lesion.h"

namespace mammotwin {

/// What lies round a lesion is looked at this far from it [mm].
inline constexpr double shell_from_mm = 2, shell_to_mm = 6;

/// Vessels are thinner, the lobes of a large lesion are not.
inline constexpr double most_opening_mm = 3;

std::size_t count(const Volume<std::uint8_t>& mask);

/// The voxels of a grid that `keep(place, offset)` keeps.
template <class Keep>
Volume<std::uint8_t> where(const Volume<std::uint8_t>& grid, const Keep& keep) {
  auto out = grid.like<std::uint8_t>(0);
  std::size_t v = 0;
  for (int k = 0; k < grid.size.z(); ++k)
    for (int j = 0; j < grid.size.y(); ++j)
      for (int i = 0; i < grid.size.x(); ++i, ++v) out.values[v] = keep(grid.position(i, j, k), v);
  return out;
}

/// Distance of voxels inside to what lies outside [mm].
Volume<float> inner_distance(const Volume<std::uint8_t>& mask);

/// How much is opened away of a lesion, so that vessels and ducts fall off [mm].
double opening_of(const FoundLesion& lesion);

/// A lesion's voxels and what lies around them.
struct LesionRegion {
  const Volume<std::uint8_t>&mask, &allowed;
  Volume<float> depth, away;  ///< of voxels inside and outside [mm]

  LesionRegion(const Volume<std::uint8_t>& lesion, const Volume<std::uint8_t>& may);

  /// Median of what lies deeper inside than `opening_mm`.
  double brightness(const Volume<float>& image, double opening_mm) const;
  /// Of the shell around it; empty if none of it is allowed.
  std::optional<double> background(const Volume<float>& image) const;
};

}  // namespace mammotwin
